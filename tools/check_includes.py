#!/usr/bin/env python3
"""Checks the dependency rules: which modules a module may include, and which files may include a library.

Usage: check_includes.py [ROOT]. Prints each violation as file:line; exits with 1 if there is one.
"""
import pathlib
import re
import sys

# Module -> other modules it may include. A folder within a module may have its own line.
BASIC = {"lib/core", "lib/config"}
PHYSICS = BASIC | {"lib/material", "lib/mesh", "lib/material_axes", "lib/element", "lib/ode", "lib/statics", "lib/linear", "lib/fem",
                   "lib/analysis"}
STUDY = PHYSICS | {"lib/scene", "lib/simulation"}
ALLOWED = {
    "lib/core": set(),
    "lib/config": {"lib/core"},
    "lib/material": BASIC,
    "lib/mesh": BASIC | {"lib/element"},
    "lib/linear": {"lib/core"},
    "lib/petsc": {"lib/core", "lib/linear"},
    "lib/ode": BASIC,
    "lib/statics": BASIC | {"lib/ode"},
    "lib/element": {"lib/core", "lib/material"},
    "lib/material_axes": BASIC | {"lib/mesh", "lib/fem"},
    "lib/fem": BASIC | {"lib/material", "lib/mesh", "lib/element", "lib/ode", "lib/linear"},
    "lib/analysis": BASIC | {"lib/material", "lib/mesh", "lib/element", "lib/ode", "lib/statics", "lib/linear", "lib/fem"},
    "lib/scene": PHYSICS,
    "lib/simulation": PHYSICS | {"lib/scene"},
    "lib/study/inputs": STUDY,
    "lib/study/jobs": STUDY,
    "lib/study/quantities": STUDY | {"lib/study/inputs"},
    "lib/study/compare": STUDY | {"lib/study/inputs", "lib/study/jobs"},
    "lib/study/points": STUDY | {"lib/study/inputs", "lib/study/jobs", "lib/study/quantities"},
    "lib/study/converge": STUDY | {"lib/study/inputs", "lib/study/jobs", "lib/study/quantities", "lib/study/points"},
    "lib/study/sweep": STUDY | {"lib/study/inputs", "lib/study/jobs", "lib/study/quantities", "lib/study/points"},
    "lib/study/stability": STUDY | {"lib/study/inputs", "lib/study/jobs", "lib/study/quantities"},
    "integrators": BASIC | {"lib/ode", "lib/statics", "lib/linear"},
}
# Include prefix of a library -> the only places that may include it.
LIBRARIES = {
    r"yaml-cpp/": ["lib/config/yaml_document.h"],
    r"(sundials|cvode|ida|arkode|kinsol|nvector|sunmatrix|sunlinsol)/": ["integrators/", "lib/petsc/parallel_vector.cc"],
    r"petsc\w*\.h": ["lib/petsc/"],
    r"mpi\.h": ["lib/petsc/"],
    r"(cholmod|klu)\.h": ["lib/linear/"],
    r"muParser": ["lib/config/formula.cc"],
    r"udunits2\.h": ["lib/core/units.cc"],
    r"pugixml": ["lib/mesh/io/vtu"],
    r"zlib\.h": ["lib/mesh/io/vtu"],
    r"Spectra/": ["lib/linear/negative_eigenpairs.cc", "lib/linear/eigenmodes.cc"],
    r"boost/": ["lib/simulation/output/event_finder.cc", "lib/simulation/output/time_extreme.cc", "lib/study/fit/statistics.cc"],
    r"ceres/": ["lib/study/fit/search.cc"],
    r"CLI/": ["tools/orthodyn/command_line.cc", "tools/bench/orthodyn_bench.cc"],
    r"nlohmann/": ["lib/simulation/checkpoint/checkpoint.cc", "lib/simulation/output/json.h", "lib/study/", "tools/", "tests/"],
}
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]')
VERSION_SWITCH = re.compile(r"^\s*#\s*(?:el)?if.*SUNDIALS_VERSION")


def module_of(path):
    return next((m for m in ALLOWED if path == m or path.startswith(m + "/")), None)


def violations(path, line):
    if VERSION_SWITCH.match(line) and path != "integrators/sundials/version.h":
        yield "tests the SUNDIALS version; only integrators/sundials/version.h may"
    match = INCLUDE.match(line)
    if not match:
        return
    included, module = match.group(1), module_of(path)
    for prefix, places in LIBRARIES.items():
        if re.match(prefix, included) and not module_of(included) and not any(path.startswith(p) for p in places):
            yield f"includes {included}; only {', '.join(places)} may"
    target = module_of(included)
    if module and included.startswith(("tools/", "tests/")):
        yield f"includes {included}: nothing includes tools or tests"
    if module and target and target != module and target not in ALLOWED[module]:
        yield f"includes {included}: {module} may not depend on {target}"


def main(root):
    found = 0
    for folder in ("lib", "integrators", "tools", "tests"):
        for file in sorted(pathlib.Path(root, folder).rglob("*.[ch]*")):
            if file.suffix not in (".h", ".cc"):
                continue
            path = file.relative_to(root).as_posix()
            for number, line in enumerate(file.read_text().splitlines(), 1):
                for violation in violations(path, line):
                    print(f"{path}:{number}: {violation}")
                    found += 1
    return 1 if found else 0


if __name__ == "__main__":
    if len(sys.argv) > 2:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1] if len(sys.argv) == 2 else str(pathlib.Path(__file__).resolve().parents[1])))

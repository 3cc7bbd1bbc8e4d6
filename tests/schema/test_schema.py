"""The JSON Schema of the input, checked with an independent validator: it accepts every shipped file and refuses
the same input as orthodyn. ORTHODYN_EXECUTABLE names the program."""
import json
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

import jsonschema
import yaml

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXECUTABLE = os.environ["ORTHODYN_EXECUTABLE"]
MODELINE = re.compile(r"^# yaml-language-server: \$schema=(\S+)$")


class Loader(yaml.SafeLoader):
    """Reads numbers as YAML 1.2 does, like editors and orthodyn: 1e-3 is a number."""


Loader.yaml_implicit_resolvers = {c: [(tag, r) for tag, r in resolvers if tag != "tag:yaml.org,2002:float"]
                                  for c, resolvers in yaml.SafeLoader.yaml_implicit_resolvers.items()}
Loader.add_implicit_resolver("tag:yaml.org,2002:float", re.compile(r"^[-+]?(\.\d+|\d+(\.\d*)?)([eE][-+]?\d+)?$"),
                             list("-+.0123456789"))


def output_of(*arguments):
    return subprocess.run([EXECUTABLE, *arguments], check=True, capture_output=True, text=True).stdout


def schema_of(kind):
    return json.loads(output_of("schema", *([kind] if kind else [])))


def errors(text, schema):
    return list(jsonschema.Draft7Validator(schema).iter_errors(yaml.load(text, Loader)))


KINDS = ("scene", "comparison", "sweep", "fit", "stability")


def shipped(kind):
    folders = {"scene": ["scenes", "cases", "benchmarks", "vega", "stability/cases"], "comparison": ["comparisons"],
               "sweep": ["sweeps"], "fit": ["fits"], "stability": ["stability"]}[kind]
    return [p for folder in folders for p in sorted((ROOT / "configs" / folder).glob("*.yaml"))]


SCENE = """
mesh: {type: box, size: [1, 0.1, 0.1], cells: [4, 1, 1], order: 1}
materials:
  wood: {type: orthotropic_stable, density: 450, young: [10e9, 1e9, 1e9], nu: 0.3}
clamps: [{surface: x0}]
gravity: [0, 0, -9.81]
time: {end: 1e-3}
"""
# Mistake -> (text in SCENE, its replacement, path that an editor should mark).
BROKEN = {
    "an unknown key": ("clamps:", "clmaps:", []),
    "an unknown key within": ("cells: [4, 1, 1]", "cells: [4, 1, 1], spilt: six", ["mesh"]),
    "an unknown type": ("type: box", "type: ball", ["mesh", "type"]),
    "a text for a number": ("density: 450", "density: heavy", ["materials", "wood", "density"]),
    "a number out of range": ("nu: 0.3", "nu: 0.5", ["materials", "wood", "nu"]),
    "a list that is too short": ("size: [1, 0.1, 0.1]", "size: [1, 0.1]", ["mesh", "size"]),
    "a fraction for a whole number": ("cells: [4, 1, 1]", "cells: [4.5, 1, 1]", ["mesh", "cells", 0]),
    "a missing key": ("time: {end: 1e-3}", "time: {start: 0}", ["time"]),
    "a missing section": ("mesh: {type: box, size: [1, 0.1, 0.1], cells: [4, 1, 1], order: 1}", "", []),
    "a section for a list": ("clamps: [{surface: x0}]", "clamps: {surface: x0}", ["clamps"]),
    "a word that is none of the allowed": ("time:", "mass: heavy\ntime:", ["mass"]),
    "a key of another type": ("nu: 0.3", "nu: 0.3, nu12: 0.3", ["materials", "wood"]),
}

# Kind of key -> (text in SCENE, its replacement with VALUE, {value: whether schema and orthodyn allow it}).
GRAIN = "regions: {body: {material: wood, axes: {type: axis_angle, axis: [0, 0, 1], angle: VALUE}}}\ntime:"
VALUES = {
    "a length": ("size: [1,", "size: [VALUE,",
                 {"1": True, "1 m": True, "1m": True, "+1 m": True, "100 cm": True, "1e3 mm": True, "1.e0 m": True, "'1'": False,
                  ".001 km": True, "-1": False, "0": False, "m": False, "1 1": False, "'1 m 2'": False,
                  "1 m, 2 m, 3": False, "''": False, "true": False, "'+-1 m'": False, "'+ 1 m'": False}),
    "a density": ("450", "VALUE", {"0.45 g/cm^3": True, "450 kg/m3": True, "450 kg m-3": True, "450 kg/m^3": True,
                                   "450 kg.m-3": True, "heavy": False, "0": False}),
    "a rate": ("time:", "damping: {mass: VALUE}\ntime:",
               {"1": True, "1 1/s": True, "1 s-1": True, "1 s^-1": True, "1 Hz": True, "1 1 s": False, "1/s": False,
                "-1": False}),
    "a time": ("1e-3", "VALUE", {"1 ms": True, "1 us": True, "1e-3 s": True, "2 1": False, "null": False}),
    "a direction with a unit": ("-9.81]", "VALUE]", {"-9.81 m/s^2": True, "-9.81 m/s2": True, "-1 cm s-2": True,
                                                     "g": False}),
    "an angle": ("time:", GRAIN, {"0": True, "0.0": True, "30 deg": True, "0.5 rad": True, "30": False, "-1e-3": False,
                                  "deg": False}),
    "a number without a unit": ("nu: 0.3", "nu: VALUE", {"0": True, ".1": True, "1e-1": True, "0.3 1": False,
                                                         "0.5": False, "30 %": False}),
    "a whole number": ("cells: [4,", "cells: [VALUE,", {"4": True, "4.0": True, "4e0": True, "4.5": False,
                                                        "0": False, "4 m": False, "'4'": False}),
    "a truth": ("time:", "output: {energy: VALUE}\ntime:", {"true": True, "false": True, "1": False, "maybe": False,
                                                                    "null": True, "'true'": False}),
    "a number or nothing": ("time:", "output: {frames: VALUE}\ntime:", {"5": True, "null": True, "'5'": False,
                                                                        "'null'": False}),
    "a section or nothing": ("time:", "damping: VALUE\ntime:", {"{mass: 1}": True, "null": True, "{mass: null}": True,
                                                                "'null'": False, "[]": False}),
    "a section with a type, or nothing": ("time:", "integrator: VALUE\ntime:",
                                          {"{type: cvode_bdf}": True, "null": True, "{type: null}": False}),
    "a list or nothing": ("clamps: [{surface: x0}]", "clamps: VALUE",
                          {"[{surface: x0}]": True, "null": True, "[null]": False}),
    "a word": ("time:", "mass: VALUE\ntime:", {"lumped": True, "'lumped'": True, "null": True,
                                                      "Lumped": False, "[lumped]": False}),
    "fields of frames": ("time:", "output: {fields: VALUE}\ntime:",
                         {"[]": True, "[displacement, stress]": True, "[displacment]": False, "displacement": False,
                          "[energy.kinetic]": False}),
    "fields of a probe": ("time:", "output: {probes: {tip: {at: [1, 0, 0], fields: VALUE}}}\ntime:",
                          {"[velocity]": True, "[det_f]": False, "[speed]": False}),
    "the value of an event": (
        "time:", "events: [{quantity: energy.kinetic, crosses: VALUE}]\ntime:",
        {"1": True, "1 mJ": True, "1e-3 N m": True, "much": False, "[1]": False}),
    "an expected value": (
        "time:", "expect: [{quantity: energy.kinetic, value: VALUE, absolute: 1, source: s, reason: r}]\ntime:",
        {"1": True, "1 mJ": True, "none": False}),
    "a tolerance": (
        "time:", "expect: [{quantity: energy.kinetic, value: 1, absolute: VALUE, source: s, reason: r}]\ntime:",
        {"1": True, "1 mJ": True, "-1": False, "0": False}),
    "a factor": ("time:", "loads: [{surface: x1, force: [1, 0, 0], factor: VALUE}]\ntime:",
                 {"{type: ramp, end: 1e-4}": True, "{type: ramp, end: 0.1 ms}": True, "{type: sine}": False,
                  "{type: sine, frequency: 1 kHz, phase: 90 deg}": True, "{type: sine, frequency: 1, phase: 90}": False,
                  "{type: table, points: [[0, 0], [1 ms, 1]]}": True}),
    "a traction": ("time:", "loads: [{surface: x1, traction: [VALUE, 0, 0]}]\ntime:",
                   {"1": True, "12 kPa": True, "9810*(2 - z)": True, "-z": True, "[1]": False,
                    "'1'": True}),
    "an accuracy": ("time:", "integrator: {rtol: VALUE}\ntime:", {"1e-4": True, "1": False, "1 m": False}),
}


class Schema(unittest.TestCase):
    def test_is_a_schema(self):
        for kind in (*KINDS, None):
            jsonschema.Draft7Validator.check_schema(schema_of(kind))

    def test_a_default_is_among_the_allowed_words(self):
        found = 0
        for kind in KINDS:
            for section in schema_of(kind)["definitions"].values():
                for name, key in section.get("properties", {}).items():
                    if "enum" in key and "default" in key:
                        found += 1
                        self.assertIn(key["default"], key["enum"], name)
        self.assertGreater(found, 2)

    def test_takes_every_shipped_file(self):
        for kind in KINDS:
            schema, both = schema_of(kind), schema_of(None)
            for path in shipped(kind):
                with self.subTest(path=path.name):
                    for judge in (schema, both):
                        self.assertEqual([e.message for e in errors(path.read_text(), judge)], [])

    def test_there_are_many_shipped_files(self):
        self.assertGreater(len(shipped("scene")), 30)
        self.assertGreater(len(shipped("comparison")), 5)

    def test_takes_units_where_a_key_has_one(self):
        schema = schema_of("scene")
        self.assertEqual(errors(SCENE.replace("450", "0.45 g/cm^3"), schema), [])
        self.assertNotEqual(errors(SCENE.replace("nu: 0.3", "nu: 0.3 m"), schema), [])

    def test_takes_keys_from_included_files(self):
        self.assertEqual(errors(SCENE.replace("time: {end: 1e-3}", "include: time.yaml"), schema_of("scene")), [])

    def test_refuses_broken_scenes_where_they_are_broken(self):
        schema = schema_of("scene")
        self.assertEqual(errors(SCENE, schema), [])
        for name, (old, new, place) in BROKEN.items():
            with self.subTest(name):
                self.assertIn(old, SCENE)
                found = errors(SCENE.replace(old, new), schema)
                self.assertIn(place, [list(e.absolute_path) for e in found], [e.message for e in found])

    def test_orthodyn_refuses_the_same_broken_scenes(self):
        with tempfile.TemporaryDirectory() as folder:
            scene = pathlib.Path(folder) / "scene.yaml"
            scene.write_text(SCENE)
            self.assertEqual(subprocess.run([EXECUTABLE, "check", scene], capture_output=True).returncode, 0)
            for name, (old, new, _) in BROKEN.items():
                with self.subTest(name):
                    scene.write_text(SCENE.replace(old, new))
                    self.assertEqual(subprocess.run([EXECUTABLE, "check", scene], capture_output=True).returncode, 2)

    def test_takes_the_same_values_as_orthodyn(self):
        schema = schema_of("scene")
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "scene.yaml"
            for name, (old, new, values) in VALUES.items():
                for value, allowed in values.items():
                    text = SCENE.replace(old, new.replace("VALUE", value))
                    path.write_text(text)
                    with self.subTest(name, value=value):
                        self.assertIn(old, SCENE)
                        self.assertEqual(errors(text, schema) == [], allowed, "schema")
                        done = subprocess.run([EXECUTABLE, "check", path], capture_output=True, text=True)
                        self.assertEqual(done.returncode, 0 if allowed else 2, done.stderr)


class Committed(unittest.TestCase):
    def test_schemas_are_up_to_date(self):
        for kind in KINDS:
            self.assertEqual((ROOT / "configs/schema" / f"{kind}.json").read_text(), output_of("schema", kind),
                             f"run: orthodyn schema {kind} > configs/schema/{kind}.json")

    def test_the_reference_page_is_up_to_date(self):
        self.assertEqual((ROOT / "docs/reference.md").read_text(), output_of("list", "--markdown"),
                         "run: orthodyn list --markdown > docs/reference.md")

    def test_shipped_files_name_their_schema(self):
        for kind in KINDS:
            for path in shipped(kind):
                with self.subTest(path=path.name):
                    line = MODELINE.match(path.read_text().splitlines()[0])
                    self.assertTrue(line, "the first line names no schema")
                    self.assertEqual((path.parent / line.group(1)).resolve(), ROOT / "configs/schema" / f"{kind}.json")


class Init(unittest.TestCase):
    def test_start_files_are_valid(self):
        with tempfile.TemporaryDirectory() as folder:
            for kind in KINDS:
                path = pathlib.Path(folder) / f"{kind}.yaml"
                output_of("init", kind, str(path))
                self.assertEqual(errors(path.read_text(), schema_of(kind)), [])
                named = MODELINE.match(path.read_text().splitlines()[0])
                self.assertEqual(json.loads(pathlib.Path(named.group(1)).read_text())["title"], f"orthodyn {kind}")
            output_of("check", f"{folder}/scene.yaml")

    def test_an_existing_file_is_kept(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "mine.yaml"
            path.write_text("mine")
            again = subprocess.run([EXECUTABLE, "init", "scene", path], capture_output=True, text=True)
            self.assertEqual(again.returncode, 2)
            self.assertIn("already exists", again.stderr)
            self.assertEqual(path.read_text(), "mine")


if __name__ == "__main__":
    unittest.main()

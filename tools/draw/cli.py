"""The commands of `draw`. They print the path of each file that they write."""
import math
import sys
from pathlib import Path

from .errors import DrawError
from .options import MOST_FRAMES, parsed

def _picture_spec(args):
    return {"color": args.color, "view": args.view, "up": args.up, "scale": args.scale, "grain": args.grain,
            "ghost": args.ghost, "limits": args.range}


def _out(args, name, suffix=".png"):
    """The path given, or pictures/NAME in the result, with the field that colours the body if one is given."""
    colour = getattr(args, "color", None)
    return args.out or Path(args.result) / "pictures" / (name + (f"_{colour}" if colour else "") + suffix)


def _frame(args):
    from . import picture, scene, series
    frames = series.Series(args.result)
    index = frames.asked_at(args.time) if args.time is not None else frames.checked_index(
        -1 if args.index is None else args.index)
    yield picture.draw_frame(scene.Scene(frames, [index], scene.PictureSpec(**_picture_spec(args))), index,
                             _out(args, f"frame_{index:05d}"), args.size)


def _strip(args):
    from . import picture, scene, series
    frames = series.Series(args.result)
    indices = [frames.asked_at(t) for t in args.times] if args.times else frames.telling(args.count)
    spec = scene.PictureSpec(**_picture_spec(args))
    yield picture.draw_strip(scene.Scene(frames, indices, spec), indices, _out(args, "strip"))


def _animate(args):
    from . import animation, scene, series
    frames = series.Series(args.result)
    indices = range(0, len(frames), args.every or math.ceil(len(frames) / MOST_FRAMES))
    yield animation.draw_animation(scene.Scene(frames, indices, scene.PictureSpec(**_picture_spec(args))), indices,
                                   _out(args, "animation", ".gif"), args.fps)


def _curve(args):
    from . import curves, series
    folder = series.result_folder(args.result)
    yield curves.draw_curve(args.command, folder, _out(args, args.command))


def _load(args):
    from . import load_path, series
    yield load_path.draw_load_path(series.result_folder(args.result), _out(args, "load"))


def _response(args):
    from . import response, series
    yield response.draw_response(series.result_folder(args.result), _out(args, "response"))


def _spectrum(args):
    from . import series, spectrum
    yield spectrum.draw_spectrum(series.result_folder(args.result), _out(args, "spectrum"))


def _compare(args):
    from .compare import draw_comparison
    yield from draw_comparison(args.results, args.out or Path(args.results[-1]) / "pictures")


def _hint_of_scale(args):
    """Says on stderr if the motion is too small to see, and which --scale shows it."""
    from .series import Series
    if args.scale != 1:
        return
    series = Series(args.result)
    if scale := series.visible_scale:
        _, largest, extent = series.peak
        print(f"draw: the largest motion is {100 * largest / extent:.2g} % of the body: --scale {scale:g} shows it",
              file=sys.stderr)


def _all(args):
    """Draws everything that the folder has data for."""
    from .curves import CURVES
    from .load_path import has_load_path
    from .response import has_response
    from .series import result_folder
    folder = result_folder(args.result)
    parts = [(name, (folder / f"{name}.csv").is_file(), _curve) for name in CURVES]
    parts = [(name, (folder / "frames.pvd").is_file(), run) for name, run in
             (("strip", _strip), ("animate", _animate))] + parts
    parts.append(("load", has_load_path(folder), _load))
    parts.append(("response", has_response(folder), _response))
    parts.append(("modes", (folder / "modes.pvd").is_file(), _modes_of_run))
    if not any(present for _, present, _ in parts):
        raise DrawError(f"{folder}: neither frames.pvd nor any of {', '.join(f'{c}.csv' for c in CURVES)}; "
                        "is it a result folder of `orthodyn run`?")
    for name, present, run in parts:
        if present:
            args.command = name
            yield from run(args)
    if (folder / "frames.pvd").is_file():
        _hint_of_scale(args)


def _report(args):
    from .converge import reading as converge, write_convergence_report
    from .fit import reading as fit, write_fit_report
    from .report import write_report
    from .stability import reading as stability, write_stability_report
    from .sweep import reading as sweep, write_sweep_report
    write = {stability.KIND.file: write_stability_report, sweep.KIND.file: write_sweep_report,
             converge.KIND.file: write_convergence_report, fit.KIND.file: write_fit_report}
    found = [name for name in write if (Path(args.result) / name).is_file()]
    yield from (write[found[0]] if found else write_report)(args.result, args.out)


def _axes(args):
    from .axes import draw_axes
    from .vtu import read_vtu
    path = Path(args.result)
    yield draw_axes(path, read_vtu(path), args.out or path.with_suffix(".png"), args.at, args.view)


def _modes_of_run(args):
    from .modes import draw_modes
    path = Path(args.result) / "pictures" / "modes.png"
    path.parent.mkdir(exist_ok=True)
    yield draw_modes(args.result, path, 12, (-60.0, 20.0), "z")


def _modes(args):
    from .modes import draw_modes
    yield draw_modes(args.result, args.out or Path(args.result) / "modes.png", args.count, args.view, args.up)


def _view(args):
    from .view import page
    from .view.collect import Extent
    from .view_sources import sources_of
    start = {key: value for key, value in (("time", args.time), ("color", args.color), ("scale", args.scale)) if value is not None}
    extent = Extent(args.volume, args.fields, args.every)
    if args.png and args.out:
        raise DrawError("--out and --png exclude each other: --png writes a picture instead of the page")
    if args.png:
        yield page.write_still(sources_of(args.results), args.png, args.size, extent, start)
    else:
        yield page.write_view(sources_of(args.results), args.out, extent, start)


COMMANDS = {"view": _view, "report": _report, "compare": _compare, "load": _load, "response": _response,
            "spectrum": _spectrum, "axes": _axes, "modes": _modes,
            "frame": _frame, "strip": _strip, "animate": _animate, "all": _all}


def main(arguments=None):
    """Runs a command. Returns the exit code: 0, or 2 after an error, which is one line on stderr."""
    try:
        args = parsed(sys.argv[1:] if arguments is None else arguments)
        for path in COMMANDS.get(args.command, _curve)(args):
            print(path)
    except DrawError as error:
        print(f"draw: {error}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"draw: {error.filename or ''}: {error.strerror}", file=sys.stderr)
        return 2
    return 0

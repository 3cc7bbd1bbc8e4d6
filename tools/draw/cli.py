"""The commands of `draw`: arguments in, pictures out, one line per file written."""
import argparse
import math
import re
import sys
from pathlib import Path

from .errors import DrawError

HELP = """Draws what `orthodyn run` has written into a result folder.

examples:
  draw all out/beam                                    everything, into out/beam/pictures
  draw frame out/beam --time 0.5 --grain               one picture, the grain as short strokes
  draw frame out/beam --color nodal_stress_material.11 stress along the grain, at the last frame
  draw frame out/beam --color velocity.z --view 0,0    seen along x
  draw strip out/beam --count 6 --ghost                six frames with the rest shape's outline
  draw strip out/beam --times 0,0.1,0.4 --scale 20     deformation enlarged twenty times
  draw animate out/beam --every 4 --fps 20
  draw energy out/beam
  draw load out/shelf                                  load over displacement of a static analysis
  draw view out/beam                                   a page with a 3D view that opens offline
  draw compare out/a out/b                             probes and energies of two runs over each other
  draw report out/compare                              a comparison as one page, report.html
  draw axes out/axes/stem/axes.vtu                     material axes, which `orthodyn check --axes` wrote
  draw modes out/modes/tuning_fork                     natural modes, which `orthodyn modes` wrote"""
COLORS = """colours (--color FIELD[.COMPONENT]):
  displacement, velocity      .x .y .z .magnitude (default)
  stress                      .xx .yy .zz .xy .yz .zx .magnitude .von_mises (default)
  stress_material             .11 .22 .33 .12 .23 .31 .magnitude .von_mises (default)
  strain                      .11 .22 .33 .12 .23 .31 .magnitude (default); 1 is along the grain
  nodal_stress, ...           likewise, recovered at the nodes: for quadratic elements
  det_f, region               volume ratio; one colour per region
  principal_stress, _strain   .1 (default) .2 .3; von_mises, max_stress, tsai_wu, hashin have no components
  Without --color: the first that frames carry of nodal_stress.von_mises, von_mises, stress.von_mises;
  else displacement.
  The range of stresses, strains and other cell fields leaves out the outermost 0.4 % at either
  end, where the colour bar then has a tip; --range gives it exactly. It is one range for all frames of a picture."""
MOST_FRAMES = 60


def _numbers(text, count=None, separator=","):
    """'1,2' as floats."""
    try:
        values = tuple(float(part) for part in text.split(separator))
    except ValueError:
        values = ()
    if not values or (count and len(values) != count) or not all(map(math.isfinite, values)):
        wanted = f"{count} numbers" if count else "numbers"
        raise argparse.ArgumentTypeError(f"'{text}' should be {wanted} separated by '{separator}'")
    return values


def _positive(text):
    value = _numbers(text, 1)[0]
    if value <= 0:
        raise argparse.ArgumentTypeError(f"'{text}' should be above zero")
    return value


def _count(text):
    value = _positive(text)
    if value != int(value):
        raise argparse.ArgumentTypeError(f"'{text}' should be a whole number")
    return int(value)


def _size(text):
    values = _numbers(text.lower(), 2, "x")
    if min(values) < 400 or max(values) > 10000:
        raise argparse.ArgumentTypeError(f"'{text}' should be between 400x400 and 10000x10000 pixels")
    return tuple(int(v) for v in values)


class _Parser(argparse.ArgumentParser):
    def error(self, message):
        raise DrawError(f"{message}; see `{self.prog} --help`")


def _parser():
    parser = _Parser(prog="draw", description=HELP, formatter_class=argparse.RawDescriptionHelpFormatter,
                     epilog="`draw COMMAND --help` explains one command.")
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND", parser_class=_Parser)

    def command(name, sentence, epilog=None):
        sub = commands.add_parser(name, help=sentence, description=sentence, epilog=epilog,
                                  formatter_class=argparse.RawDescriptionHelpFormatter)
        sub.add_argument("result", metavar="RESULT", help="folder that `orthodyn run` wrote")
        sub.set_defaults(out=None)
        if name != "all":
            sub.add_argument("--out", type=Path, metavar="FILE", help="default: a file in RESULT/pictures")
        return sub

    def body(name, sentence):
        sub = command(name, sentence, COLORS)
        sub.add_argument("--color", metavar="FIELD[.COMPONENT]", help="what colours the body, see below")
        sub.add_argument("--range", type=lambda s: _numbers(s, 2), metavar="LOW,HIGH", help="colour range, SI units")
        sub.add_argument("--view", type=lambda s: _numbers(s, 2), default=(-60.0, 20.0), metavar="AZIM,ELEV",
                         help="where the eye is, degrees about the axis that is up (default -60,20)")
        sub.add_argument("--up", choices="xyz", default="z", help="the axis that is up (default z)")
        sub.add_argument("--scale", type=lambda s: _numbers(s, 1)[0], default=1.0, metavar="S",
                         help="enlarges the deformation (default 1: true shape)")
        sub.add_argument("--grain", action="store_true", help="material axis 1 as strokes on the surface")
        sub.add_argument("--ghost", action="store_true", help="outline of the rest shape")
        return sub

    frame = body("frame", "One frame as PNG (default: the last).")
    which = frame.add_mutually_exclusive_group()
    which.add_argument("--time", type=lambda s: _numbers(s, 1)[0], metavar="T", help="the frame nearest to T seconds")
    which.add_argument("--index", type=int, metavar="K", help="frame number, from 0; -1 is the last")
    frame.add_argument("--size", type=_size, metavar="WxH", help="pixels (default: 1600 wide or as the body needs)")

    strip = body("strip", "Several frames side by side as PNG, with one view and one colour range.")
    which = strip.add_mutually_exclusive_group()
    which.add_argument("--times", type=_numbers, metavar="T1,T2,...", help="the frames nearest to these seconds")
    which.add_argument("--count", type=_count, default=6, metavar="N",
                       help="N frames over the whole time, that of the largest displacement among them (default 6)")

    animate = body("animate", "All frames as GIF below 4 MB.")
    animate.add_argument("--fps", type=_positive, default=15.0, help="frames per second (default 15)")
    animate.add_argument("--every", type=_count, metavar="K",
                         help=f"every K-th frame (default: so that at most {MOST_FRAMES} remain)")

    command("energy", "Energies over time and their balance, from energy.csv.")
    command("steps", "Step size with order and rejections, Newton iterations, from steps.csv.")
    command("probes", "Probed values over time, from probes.csv.")
    command("momentum", "Linear and angular momentum over time, from momentum.csv.")
    command("load", "Load factor over displacement of a static analysis.")
    both = "Probes and energies of two to four results over each other, with how far they differ."
    compare = commands.add_parser("compare", help=both, description=both)
    compare.add_argument("results", metavar="RESULT", nargs="+", help="folders that `orthodyn run` wrote")
    compare.add_argument("--out", type=Path, metavar="FOLDER", help="default: the pictures of the last RESULT")
    page = "One HTML page and figures for papers of a comparison, a sweep or a matrix of hard cases."
    report = commands.add_parser("report", help=page, description=page)
    report.add_argument("result", metavar="RESULT", help="folder that `orthodyn compare`, `sweep`, `converge` or `stability` wrote")
    report.add_argument("-o", "--out", type=Path, metavar="FILE", help="the page (default: RESULT/report.html)")
    axes = commands.add_parser("axes", help="Material axes on the surface and in two sections, from axes.vtu.",
                               description="Material axes on the surface and in two sections, as PNG.")
    axes.add_argument("result", metavar="FILE", help="axes.vtu, which `orthodyn check --axes` wrote")
    axes.add_argument("--out", type=Path, metavar="PNG", help="default: FILE with the ending .png")
    axes.add_argument("--at", type=lambda s: _numbers(s, 3), metavar="X,Y,Z",
                      help="point that the sections go through (default: the middle of the body)")
    axes.add_argument("--view", type=lambda s: _numbers(s, 2), default=(-60.0, 20.0), metavar="AZIM,ELEV",
                      help="where the eye is for the surface, degrees (default -60,20; z is up)")
    modes = commands.add_parser("modes", help="Natural modes or buckling shapes side by side.",
                                description="Natural modes or buckling shapes side by side as PNG, with the rest shape's outline.")
    modes.add_argument("result", metavar="RESULT", help="folder of `orthodyn modes`, or of a run with analysis: buckling")
    modes.add_argument("--out", type=Path, metavar="PNG", help="default: RESULT/modes.png")
    modes.add_argument("--count", type=_count, default=12, metavar="N",
                       help="the N lowest that bend the body (default 12)")
    modes.add_argument("--view", type=lambda s: _numbers(s, 2), default=(-60.0, 20.0), metavar="AZIM,ELEV",
                       help="where the eye is, degrees about the axis that is up (default -60,20)")
    modes.add_argument("--up", choices="xyz", default="z", help="the axis that is up (default z)")
    view = commands.add_parser("view", help="Results as an HTML page with a 3D view.", epilog=COLORS,
                               description="Results as one HTML page with a 3D view, which opens offline: one of them, or two side by side.",
                               formatter_class=argparse.RawDescriptionHelpFormatter)
    view.add_argument("results", metavar="RESULT", nargs="+", help="a folder that `orthodyn run`, `modes`, `sweep`, `compare` or `stability` wrote")
    view.add_argument("--out", type=Path, metavar="FILE", help="the page (default: view.html in the first RESULT)")
    view.add_argument("--volume", action="store_true", help="also what is inside, for the clip plane; a larger page")
    view.add_argument("--fields", type=lambda s: tuple(s.split(",")), metavar="F1,F2,...",
                      help="these fields only (default: all but material axes, of which the grain is drawn)")
    view.add_argument("--every", type=_count, metavar="K",
                      help="every K-th frame, and the last (default 1; of a large comparison as many as 60 MB hold)")
    view.add_argument("--time", type=lambda s: _numbers(s, 1)[0], metavar="T", help="begins at the frame nearest to T seconds")
    view.add_argument("--color", metavar="FIELD[.COMPONENT]", help="begins with this colour, see below")
    view.add_argument("--scale", type=lambda s: _numbers(s, 1)[0], metavar="S",
                      help="enlarges deflections S times, which the picture says; 1 is the true shape (default: 1, but where the "
                           "largest deflection is below 2 %% of the body as much as shows it; of a sweep what its `enlarged` "
                           "says; of modes as much as shows them)")
    view.add_argument("--png", type=Path, metavar="FILE", help="a still instead, taken by Chromium")
    view.add_argument("--size", type=_size, default=(1600, 1000), metavar="WxH", help="pixels of the still (default 1600x1000)")
    every = body("all", "Strip, animation and all curves into RESULT/pictures.")
    every.set_defaults(count=6, times=None, fps=15.0, every=None)
    return parser


def _picture_spec(args):
    return {"color": args.color, "view": args.view, "up": args.up, "scale": args.scale, "grain": args.grain,
            "ghost": args.ghost, "limits": args.range}


def _out(args, name):
    return args.out or Path(args.result) / "pictures" / name


def _frame(args):
    from . import picture, scene, series
    frames = series.Series(args.result)
    index = frames.asked_at(args.time) if args.time is not None else frames.checked_index(
        -1 if args.index is None else args.index)
    yield picture.draw_frame(scene.Scene(frames, [index], scene.PictureSpec(**_picture_spec(args))), index,
                             _out(args, f"frame_{index:05d}.png"), args.size)


def _strip(args):
    from . import picture, scene, series
    frames = series.Series(args.result)
    indices = [frames.asked_at(t) for t in args.times] if args.times else frames.telling(args.count)
    spec = scene.PictureSpec(**_picture_spec(args))
    yield picture.draw_strip(scene.Scene(frames, indices, spec), indices, _out(args, "strip.png"))


def _animate(args):
    from . import animation, scene, series
    frames = series.Series(args.result)
    indices = range(0, len(frames), args.every or math.ceil(len(frames) / MOST_FRAMES))
    yield animation.draw_animation(scene.Scene(frames, indices, scene.PictureSpec(**_picture_spec(args))), indices,
                                   _out(args, "animation.gif"), args.fps)


def _curve(args):
    from . import curves, series
    folder = series.result_folder(args.result)
    yield curves.draw_curve(args.command, folder, _out(args, f"{args.command}.png"))


def _load(args):
    from . import load_path, series
    yield load_path.draw_load_path(series.result_folder(args.result), _out(args, "load.png"))


def _compare(args):
    from .compare import draw_comparison
    yield from draw_comparison(args.results, args.out or Path(args.results[-1]) / "pictures")


def _hint_of_scale(args):
    """Enlarging is the user's choice; that the motion cannot be seen is said."""
    from .series import Series
    if args.scale != 1:
        return
    series = Series(args.result)
    if scale := series.visible_scale:
        _, largest, extent = series.peak
        print(f"draw: the largest motion is {100 * largest / extent:.2g} % of the body: --scale {scale:g} shows it",
              file=sys.stderr)


def _all(args):
    """What the folder has; the rest is left out with a word on stderr."""
    from .curves import CURVES
    from .load_path import has_load_path
    from .series import result_folder
    folder = result_folder(args.result)
    parts = [(name, (folder / f"{name}.csv").is_file(), _curve) for name in CURVES]
    parts = [(name, (folder / "frames.pvd").is_file(), run) for name, run in
             (("strip", _strip), ("animate", _animate))] + parts
    parts.append(("load", has_load_path(folder), _load))
    parts.append(("modes", (folder / "modes.pvd").is_file(), _modes_of_run))
    if not any(present for _, present, _ in parts):
        raise DrawError(f"{folder}: neither frames.pvd nor any of {', '.join(f'{c}.csv' for c in CURVES)}; "
                        "is it a folder that `orthodyn run` wrote?")
    for name, present, run in parts:
        if present:
            args.command = name
            yield from run(args)
    if (folder / "frames.pvd").is_file():
        _hint_of_scale(args)


def _report(args):
    from . import converge, stability, sweep
    from .report import write_report
    write = {stability.FILE: stability.write_stability_report, sweep.FILE: sweep.write_sweep_report,
             converge.FILE: converge.write_convergence_report}
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
    start = {key: value for key, value in (("time", args.time), ("color", args.color), ("scale", args.scale)) if value is not None}
    extent = Extent(args.volume, args.fields, args.every)
    if args.png and args.out:
        raise DrawError("--out and --png: a still is written to the latter; leave one out")
    if args.png:
        yield page.write_still(args.results, args.png, args.size, extent, start)
    else:
        yield page.write_view(args.results, args.out, extent, start)


COMMANDS = {"view": _view, "report": _report, "compare": _compare, "load": _load, "axes": _axes, "modes": _modes, "frame": _frame, "strip": _strip, "animate": _animate,
            "all": _all}


def _joined(arguments):
    """`--view -60,20` as `--view=-60,20`; argparse takes -60,20 for an option."""
    joined = []
    for argument in arguments:
        if joined and joined[-1].startswith("--") and re.match(r"-[\d.]", argument):
            joined[-1] += "=" + argument
        else:
            joined.append(argument)
    return joined


def main(arguments=None):
    """Exit code: 0, or 2 after one line on stderr."""
    try:
        args = _parser().parse_args(_joined(sys.argv[1:] if arguments is None else arguments))
        for path in COMMANDS.get(args.command, _curve)(args):
            print(path)
    except DrawError as error:
        print(f"draw: {error}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"draw: {error.filename or ''}: {error.strerror}", file=sys.stderr)
        return 2
    return 0

"""The options of `draw`."""
import argparse
import math
import re
from pathlib import Path

from .errors import DrawError

HELP = """Draws results of orthodyn.

examples:
  draw all out/beam                                    everything, into out/beam/pictures
  draw frame out/beam --time 0.5 --grain               one picture, the grain as short strokes
  draw frame out/beam --color nodal_stress_material.11 stress along the grain, at the last frame
  draw frame out/beam --color velocity.z --view 0,0    seen along x
  draw strip out/beam --count 6 --ghost                six frames with the rest shape's outline
  draw strip out/beam --times 0,0.1,0.4 --scale 20     displacements magnified 20 times
  draw animate out/beam --every 4 --fps 20
  draw energy out/beam
  draw load out/shelf                                  load over displacement of a static analysis
  draw view out/beam                                   an HTML page with a 3D view
  draw compare out/a out/b                             probes and energies of two runs in the same plots
  draw report out/compare                              a comparison as one page, report.html
  draw axes out/axes/stem/axes.vtu                     material axes written by `orthodyn check --axes`
  draw modes out/modes/tuning_fork                     natural modes written by `orthodyn modes`"""
COLORS = """colours (--color FIELD[.COMPONENT]):
  displacement, velocity      .x .y .z .magnitude (default)
  stress                      .xx .yy .zz .xy .yz .zx .magnitude .von_mises (default)
  stress_material             .11 .22 .33 .12 .23 .31 .magnitude .von_mises (default)
  strain                      .11 .22 .33 .12 .23 .31 .magnitude (default); 1 is along the grain
  nodal_stress, ...           likewise, recovered at the nodes: for quadratic elements
  det_f, region               volume ratio; one colour per region
  principal_stress, _strain   .1 (default) .2 .3; von_mises, max_stress, tsai_wu, hashin have no components
  Default: the first field present of nodal_stress.von_mises, von_mises, stress.von_mises, displacement.
  The colour range of stresses, strains and other cell fields leaves out 0.4 % of the values at either end (shown
  by a tip of the colour bar); --range sets it exactly. All frames of a picture share one range."""
MOST_FRAMES = 60


def _numbers(text, count=None, separator=","):
    """The text '1,2' as a list of floats."""
    try:
        values = tuple(float(part) for part in text.split(separator))
    except ValueError:
        values = ()
    if not values or (count and len(values) != count) or not all(map(math.isfinite, values)):
        wanted = f"{count} numbers" if count else "numbers"
        raise argparse.ArgumentTypeError(f"'{text}' is not {wanted} separated by '{separator}'")
    return values


def _number(text):
    return _numbers(text, 1)[0]


def _pair(text):
    return _numbers(text, 2)


def _positive(text):
    value = _number(text)
    if value <= 0:
        raise argparse.ArgumentTypeError(f"'{text}' is not above zero")
    return value


def _count(text):
    value = _positive(text)
    if value != int(value):
        raise argparse.ArgumentTypeError(f"'{text}' is not an integer")
    return int(value)


def _size(text):
    values = _numbers(text.lower(), 2, "x")
    if min(values) < 400 or max(values) > 10000:
        raise argparse.ArgumentTypeError(f"'{text}' is not between 400x400 and 10000x10000 pixels")
    return tuple(int(v) for v in values)


class _Parser(argparse.ArgumentParser):
    def error(self, message):
        raise DrawError(f"{message}; see `{self.prog} --help`")


def _add_direction(parser):
    parser.add_argument("--view", type=_pair, default=(-60.0, 20.0), metavar="AZIM,ELEV",
                        help="direction of view in degrees about the up axis (default -60,20)")
    parser.add_argument("--up", choices="xyz", default="z", help="the up axis (default z)")


def _parser():
    parser = _Parser(prog="draw", description=HELP, formatter_class=argparse.RawDescriptionHelpFormatter,
                     epilog="`draw COMMAND --help` explains one command.")
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND", parser_class=_Parser)

    def command(name, sentence, epilog=None):
        sub = commands.add_parser(name, help=sentence, description=sentence, epilog=epilog,
                                  formatter_class=argparse.RawDescriptionHelpFormatter)
        sub.add_argument("result", metavar="RESULT", help="result folder of `orthodyn run`")
        sub.set_defaults(out=None)
        if name != "all":
            sub.add_argument("--out", type=Path, metavar="FILE", help="default: a file in RESULT/pictures")
        return sub

    def body(name, sentence):
        sub = command(name, sentence, COLORS)
        sub.add_argument("--color", metavar="FIELD[.COMPONENT]", help="colour the body by this field, see below")
        sub.add_argument("--range", type=_pair, metavar="LOW,HIGH", help="colour range in SI units (default: the range of the values)")
        _add_direction(sub)
        sub.add_argument("--scale", type=_number, default=1.0, metavar="S",
                         help="magnify displacements S times (default 1: true shape)")
        sub.add_argument("--grain", action="store_true", help="draw material axis 1 as strokes on the surface")
        sub.add_argument("--ghost", action="store_true", help="draw the outline of the rest shape")
        return sub

    frame = body("frame", "One frame as PNG (default: the last).")
    which = frame.add_mutually_exclusive_group()
    which.add_argument("--time", type=_number, metavar="T", help="draw the frame nearest to T seconds")
    which.add_argument("--index", type=int, metavar="K", help="frame number, from 0; -1 is the last")
    frame.add_argument("--size", type=_size, metavar="WxH", help="size in pixels (default: 1600 wide, height by the body)")

    strip = body("strip", "Several frames side by side as PNG, with one view and one colour range.")
    which = strip.add_mutually_exclusive_group()
    which.add_argument("--times", type=_numbers, metavar="T1,T2,...", help="the frames nearest to these seconds")
    which.add_argument("--count", type=_count, default=6, metavar="N",
                       help="N frames over the whole time, including the one of the largest displacement (default 6)")

    animate = body("animate", "All frames as GIF below 4 MB.")
    animate.add_argument("--fps", type=_positive, default=15.0, help="frames per second (default 15)")
    animate.add_argument("--every", type=_count, metavar="K",
                         help=f"draw every K-th frame (default: at most {MOST_FRAMES} frames)")

    command("energy", "Energies over time and their balance, from energy.csv.")
    command("steps", "Step size with order and rejections, Newton iterations, from steps.csv.")
    command("probes", "Probed values over time, from probes.csv.")
    command("momentum", "Linear and angular momentum over time, from momentum.csv.")
    command("load", "Load factor over displacement of a static analysis.")
    command("response", "Amplitude and phase over the frequency of a harmonic analysis.")
    command("spectrum", "Amplitude spectra of probed values, from probes.csv with rows at equal intervals.")
    both = "Probes and energies of two to four results in the same plots, with their differences."
    compare = commands.add_parser("compare", help=both, description=both)
    compare.add_argument("results", metavar="RESULT", nargs="+", help="result folders of `orthodyn run`")
    compare.add_argument("--out", type=Path, metavar="FOLDER", help="default: the pictures of the last RESULT")
    page = "HTML report and figures for papers of a comparison, sweep, convergence study, stability matrix or fit."
    report = commands.add_parser("report", help=page, description=page)
    report.add_argument("result", metavar="RESULT", help="result folder of `orthodyn compare`, `sweep`, `converge`, "
                                                           "`stability` or `fit`")
    report.add_argument("-o", "--out", type=Path, metavar="FILE", help="the page (default: RESULT/report.html)")
    axes = commands.add_parser("axes", help="Material axes on the surface and in two sections, from axes.vtu.",
                               description="Material axes on the surface and in two sections, as PNG.")
    axes.add_argument("result", metavar="FILE", help="axes.vtu written by `orthodyn check --axes`")
    axes.add_argument("--out", type=Path, metavar="PNG", help="default: FILE with the ending .png")
    axes.add_argument("--at", type=lambda s: _numbers(s, 3), metavar="X,Y,Z",
                      help="point on the sections (default: the centre of the body)")
    axes.add_argument("--view", type=_pair, default=(-60.0, 20.0), metavar="AZIM,ELEV",
                      help="direction of view of the surface in degrees (default -60,20; z is up)")
    modes = commands.add_parser("modes", help="Natural modes or buckling shapes side by side.",
                                description="Natural modes or buckling shapes side by side as PNG, with the rest shape's outline.")
    modes.add_argument("result", metavar="RESULT", help="folder of `orthodyn modes`, or of a run with analysis: buckling or harmonic")
    modes.add_argument("--out", type=Path, metavar="PNG", help="default: RESULT/modes.png")
    modes.add_argument("--count", type=_count, default=12, metavar="N",
                       help="the N lowest modes that deform the body (default 12)")
    _add_direction(modes)
    view = commands.add_parser("view", help="Results as an HTML page with a 3D view.", epilog=COLORS,
                               description="Results as an HTML page with a 3D view that opens offline: one, or two side by side.",
                               formatter_class=argparse.RawDescriptionHelpFormatter)
    view.add_argument("results", metavar="RESULT", nargs="+", help="result folder of `orthodyn run`, `modes`, `sweep`, `compare` or `stability`")
    view.add_argument("--out", type=Path, metavar="FILE", help="the page (default: view.html in the first RESULT)")
    view.add_argument("--volume", action="store_true", help="include the interior, for cuts with the clip plane; makes the page larger")
    view.add_argument("--fields", type=lambda s: tuple(s.split(",")), metavar="F1,F2,...",
                      help="include only these fields (default: all but material axes, which are drawn as grain)")
    view.add_argument("--every", type=_count, metavar="K",
                      help="include every K-th frame and the last (default 1; for a large comparison chosen for a page of about 60 MB)")
    view.add_argument("--time", type=_number, metavar="T", help="open the page at the frame nearest to T seconds")
    view.add_argument("--color", metavar="FIELD[.COMPONENT]", help="open the page coloured by this field, see below")
    view.add_argument("--scale", type=_number, metavar="S",
                      help="magnify displacements S times; 1 is the true shape (default: 1, or more if displacements are below "
                           "2 %% of the body's size; for a sweep its `enlarged`; modes are always magnified)")
    view.add_argument("--png", type=Path, metavar="FILE", help="write a picture instead of the page; needs Chromium")
    view.add_argument("--size", type=_size, default=(1600, 1000), metavar="WxH", help="size of the picture in pixels (default 1600x1000)")
    every = body("all", "Strip, animation and all curves into RESULT/pictures.")
    every.set_defaults(count=6, times=None, fps=15.0, every=None)
    return parser


def _joined(arguments):
    """Joins `--view -60,20` to `--view=-60,20`, because argparse would take -60,20 for an option."""
    joined = []
    for argument in arguments:
        if joined and joined[-1].startswith("--") and re.match(r"-[\d.]", argument):
            joined[-1] += "=" + argument
        else:
            joined.append(argument)
    return joined


def parsed(arguments):
    """The options in `arguments`. Raises DrawError."""
    return _parser().parse_args(_joined(arguments))

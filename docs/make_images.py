"""The images of the documents, made by antinode itself: python docs/make_images.py [NAME ...]."""

import io
import math
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

import matplotlib as mpl
import numpy as np

mpl.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.text import Text
from PIL import Image, PngImagePlugin

from antinode import (
    Beam,
    Dashpot,
    Ends,
    load_beam,
    load_case,
    load_study,
    root_loci,
    sensitivity,
    solve_modes,
    solve_response,
    stability,
    sweep,
)
from antinode.modes.loading import under
from antinode.show.end_forces import plot_end_forces
from antinode.show.figures import PALETTE, plot_case, plot_loads, plot_modes
from antinode.show.figures import save as save_figure
from antinode.show.response_figures import plot_response
from antinode.show.stability_figures import plot_loci
from antinode.show.style import BODY, GREY, INK, WIDTH, styled
from antinode.study.sensitivity.command import read_uncertain
from antinode.study.sensitivity.command import tornado as plot_tornado
from antinode.study.sweep.figures import plot_sweep
from antinode.vehicle.end_forces import compare_end_forces

ROOT = Path(__file__).resolve().parents[1]
IMAGES = ROOT / "docs" / "images"
EXAMPLES = ROOT / "src" / "antinode" / "examples"
STARTER = EXAMPLES / "starter" / "case.toml"


def save(figure: Figure, path: Path) -> None:
    """Write a figure, and in the file the words that it shows: a test compares them."""
    figure.canvas.draw()
    words = [text.get_text() for text in figure.findobj(Text) if text.get_visible()]
    save_figure(figure, path)
    info = PngImagePlugin.PngInfo()
    info.add_itxt("Description", "\n".join(word for word in words if word.strip()))
    with Image.open(path) as image:
        image.load()
        image.save(path, pnginfo=info, dpi=image.info.get("dpi"), optimize=True)


def starter_modes() -> None:
    """Draw the starter vehicle in its cavity, its axial force and its modes."""
    case = load_case(STARTER)
    save(plot_case(case, solve_modes(case)), IMAGES / "starter_modes.png")


def ruler_modes() -> None:
    """Draw the steel strip of the tutorial, pinned at both ends under 600 N."""
    with TemporaryDirectory() as folder:
        path = written("tutorial.md", "ruler.toml", folder)
        pinned = ("beam.ends.left=pinned", "beam.ends.right=pinned")
        file = load_beam(path, [*pinned, "beam.stations.axial_force=[600, 600]"])
    save(plot_modes(solve_modes(file, 4)), IMAGES / "ruler_modes.png")


def written(page: str, name: str, folder: str) -> Path:
    """Write a file that a page shows, and return its path."""
    text = (Path(__file__).parent / page).read_text("utf-8").split(f"# {name}")[1].split("```")[0]
    (path := Path(folder) / name).write_text(f"# {text}", encoding="utf-8")
    return path


def howto() -> None:
    """Draw the modes of the beams of the how-to pages."""
    for name in ("tower", "rocket", "drill_string", "shaft"):
        file = load_beam(EXAMPLES / name / "beam.toml")
        result = solve_modes(file, file.solve.modes, tolerance=file.solve.tolerance)
        save(plot_modes(result), IMAGES / f"howto_{name}.png")


def end_forces() -> None:
    """Draw what the ends of the starter vehicle may do, and what that does to bending 1."""
    case = load_case(STARTER)
    result = solve_modes(case)
    shape = result.mode("bending", 1).shape
    figure = plot_end_forces(result.x, shape, compare_end_forces(case, result))
    save(figure, IMAGES / "howto_end_forces.png")


def stability_loci() -> None:
    """Draw the root loci of the rocket of the how-to page."""
    with TemporaryDirectory() as folder:
        beam = load_beam(written("howto/stability.md", "rocket.toml", folder)).beam()
    save(plot_loci(root_loci(beam, stability(beam))), IMAGES / "howto_stability.png")


def ziegler() -> None:
    """Draw how fast the fastest mode of Beck's column grows, with a dashpot at its tip."""
    forces, c = np.linspace(0.5, 21.0, 42), 1e-3
    beck = Beam.from_stations(
        [0, 1], [1, 1], [1, 1], axial_force=[1, 1], ends=Ends("clamped", right_follower=1.0)
    )
    with styled() as plt:
        figure, axes = plt.subplots(figsize=(WIDTH, 0.5 * WIDTH), layout="constrained")
        for k, kind in enumerate(("translational", "rotational")):
            damped = beck.with_attachments(Dashpot(1.0, **{kind: c}))
            growth = [
                max(m.growth_rate_per_s or 0.0 for m in solve_modes(under(damped, P), 3).modes)
                for P in forces
            ]
            label = "against its motion" if kind == "translational" else "against its turn"
            axes.plot(forces, np.array(growth) / c, color=PALETTE[k], label=f"a dashpot {label}")
        axes.axhline(0.0, color=INK, linewidth=0.7)
        axes.axvline(20.0509536190, color=INK, linewidth=0.9, linestyle=(0, (4, 3)))
        axes.annotate("flutter without damping", (20.05, -1.6), (-4, 0), textcoords="offset points",
                      ha="right", fontsize=8)  # fmt: skip
        axes.set(xlabel="force that turns with the tip [EI/L^2]", ylim=(-2, 2))
        axes.set(ylabel="growth of the fastest mode over c")
        axes.legend(loc="upper center")
        save(figure, IMAGES / "howto_ziegler.png")


def equipment() -> None:
    """Draw what the equipment of the example feels."""
    result = solve_response(EXAMPLES / "response" / "response.toml")
    save(plot_response(result), IMAGES / "howto_equipment.png")


def sweeps() -> None:
    """Draw the sweep over speed and the flight of the how-to page."""
    for name, image in (("study", "sweep_speed"), ("history", "sweep_history")):
        study = load_study(EXAMPLES / "sweep" / f"{name}.toml")
        save(plot_sweep(study, sweep(study)), IMAGES / f"{image}.png")


def tornado() -> None:
    """Draw the indices of the page on sensitivity."""
    uncertain = ("thrust=3kN", "bending_stiffness=2%", "mass_per_length=2%")
    study = read_uncertain(STARTER, (), uncertain)
    save(plot_tornado(sensitivity(study, 1024)), IMAGES / "sensitivity_tornado.png")


def speed_sweep() -> None:
    """Draw the first frequency of the starter vehicle over speed, as in the tutorial."""
    speeds = np.arange(60, 131, 10)
    figure, axes = plt.subplots(figsize=(WIDTH, 3.4), layout="constrained")
    for thrust, colour in zip((50, 100), PALETTE, strict=False):
        first = []
        for speed in speeds:
            case = load_case(
                STARTER, [f"condition.speed={speed}m/s", f"condition.thrust={thrust}kN"]
            )
            first.append(solve_modes(case, 1, families=["bending"]).mode("bending", 1).frequency_hz)
        axes.plot(speeds, first, "o-", color=colour, label=f"thrust {thrust} kN")
    axes.set(xlabel="speed [m/s]", ylabel="first bending frequency [Hz]")
    axes.legend()
    save(figure, IMAGES / "speed_sweep.png")


def literal_methods() -> None:
    """Draw the errors of the transfer matrix determinant, of det S and of the frame."""
    sys.path.insert(0, str(ROOT))
    from validation.literal_methods import FUNCTIONS, MODES, relative_errors, uniform

    figure, axes = plt.subplots(figsize=(WIDTH, 3.8), layout="constrained")
    modes, floor = np.arange(1, MODES + 1), 5e-17
    markers = zip(FUNCTIONS.items(), (PALETTE[1], PALETTE[4], PALETTE[0]), "so^", strict=True)
    for (name, function), colour, marker in markers:
        error = relative_errors(function, uniform(100))
        axes.semilogy(
            modes, np.maximum(error, floor), marker, color=colour, label=name, markersize=4
        )
        lost = modes[np.isnan(error)]
        if len(lost):
            axes.semilogy(lost, np.full(len(lost), 1.0), "x", color=colour, label=f"{name}: lost")
    growth = 1e-16 * np.exp((modes + 0.5) * math.pi)
    axes.semilogy(modes[growth < 3], growth[growth < 3], color=GREY, linewidth=0.8)
    axes.annotate("1e-16 exp($\\lambda$L)", (7.4, 1e-5), ha="right", color=GREY)
    axes.set(
        xlabel="mode of a uniform free-free beam, 100 segments",
        ylabel="relative error of the frequency [-]",
        ylim=(3e-17, 6),
    )
    axes.legend(loc="center right", bbox_to_anchor=(1.0, 0.21))
    save(figure, IMAGES / "literal_methods.png")


def conventions() -> None:
    """Draw the axis, the forces on a vehicle and the positive senses of N, Q and M."""
    figure, (top, bottom) = plt.subplots(
        2, 1, figsize=(WIDTH, 4.6), layout="constrained", height_ratios=(1.25, 1)
    )
    for axes in (top, bottom):
        axes.set_axis_off()
    _draw_vehicle(top)
    _draw_slice(bottom)
    save(figure, IMAGES / "conventions.png")


def _arrow(axes: Axes, start: tuple[float, float], end: tuple[float, float], colour: str) -> None:
    style = {"arrowstyle": "-|>", "color": colour, "linewidth": 1.6, "shrinkA": 0, "shrinkB": 0}
    axes.annotate("", end, start, arrowprops=style)


def _text(axes: Axes, at: tuple[float, float], text: str, colour: str, ha: str = "center") -> None:
    axes.text(*at, text, color=colour, ha=ha, va="center")


def _draw_vehicle(axes: Axes) -> None:
    blue, red, green = PALETTE[0], PALETTE[1], PALETTE[2]
    body = np.array([[0, 0.08], [1.5, 0.42], [6, 0.42], [6, -0.42], [1.5, -0.42], [0, -0.08]])
    axes.fill(*body.T, color=BODY, zorder=1)
    axes.plot([0, 0], [-0.22, 0.22], color=INK, linewidth=3, zorder=2)
    axes.plot([-1.4, 8.2], [0, 0], color=GREY, linewidth=0.7, linestyle=(0, (6, 3)), zorder=3)
    _arrow(axes, (7.3, 0), (8.3, 0), GREY)
    _text(axes, (8.5, 0), "x, aft", GREY, "left")
    _arrow(axes, (-0.9, 0), (-0.9, 1.2), GREY)
    _text(axes, (-0.9, 1.4), "Y, up", GREY)
    _arrow(axes, (-0.75, -0.3), (-0.05, -0.3), red)
    _text(axes, (-0.85, -0.3), "drag $F_{CX}$, aft", red, "right")
    _arrow(axes, (0, 0.25), (0, 1.0), blue)
    _text(axes, (0.12, 1.05), "lift $F_{CY}$, up", blue, "left")
    _arrow(axes, (7.1, -0.25), (6.05, -0.25), green)
    _text(axes, (7.2, -0.3), "thrust T, forward", green, "left")
    _arrow(axes, (5.2, 0.45), (5.2, 1.15), blue)
    _text(axes, (5.35, 1.1), "lift of a fin or of planing, up", blue, "left")
    _arrow(axes, (4.7, -0.65), (5.4, -0.65), red)
    _text(axes, (5.5, -0.68), "their drag, aft", red, "left")
    _arrow(axes, (2.84, 0), (2.84, -0.95), GREY)
    _text(axes, (2.95, -0.85), "weight", GREY, "left")
    turn = {
        "arrowstyle": "-|>",
        "connectionstyle": "arc3,rad=-0.45",
        "color": PALETTE[3],
        "linewidth": 1.6,
    }
    axes.annotate("", (2.0, 0.62), (2.0, -0.62), arrowprops=turn)
    _text(axes, (1.55, 0.95), "body angle, beta: nose-up", PALETTE[3], "left")
    axes.set(xlim=(-3.0, 10.2), ylim=(-1.2, 1.6))


def _draw_slice(axes: Axes) -> None:
    blue, red, pink = PALETTE[0], PALETTE[1], PALETTE[3]
    axes.fill([2.2, 4.4, 4.4, 2.2], [-0.5, -0.5, 0.5, 0.5], color=BODY)
    _arrow(axes, (1.0, 0), (2.15, 0), red)
    _text(axes, (0.9, 0), "N", red, "right")
    _arrow(axes, (5.6, 0), (4.45, 0), red)
    _text(axes, (5.7, 0), "N", red, "left")
    _arrow(axes, (2.1, -0.5), (2.1, 0.6), blue)
    _text(axes, (1.95, 0.7), "Q", blue)
    _arrow(axes, (4.5, 0.5), (4.5, -0.6), blue)
    _text(axes, (4.7, -0.6), "Q", blue)
    for start, end, rad in (
        ((1.75, 0.35), (1.75, -0.35), 0.9),
        ((4.85, 0.35), (4.85, -0.35), -0.9),
    ):
        style = {
            "arrowstyle": "<|-",
            "connectionstyle": f"arc3,rad={rad}",
            "color": pink,
            "linewidth": 1.6,
        }
        axes.annotate("", end, start, arrowprops=style)
    _text(axes, (1.25, 0.4), "M", pink)
    _text(axes, (5.35, 0.4), "M", pink)
    x = np.linspace(7.0, 9.6, 60)
    axes.plot(x, 0.45 * ((x - 8.3) / 1.3) ** 2 - 0.35, color=GREY, linewidth=3)
    _text(axes, (8.3, 0.35), "M > 0: ends up", pink)
    _text(axes, (8.3, -0.75), "$M = EI\\,Y''$,  $Q = M' + N\\,Y'$", GREY)
    _text(axes, (3.3, -0.9), "what the neighbours do to a slice", GREY)
    axes.set(xlim=(-1.4, 11.6), ylim=(-1.1, 1.0))


def gallery() -> None:
    """Draw what the gallery shows beside the images of other pages: loads, and a report."""
    from antinode.report.command import make_report
    from antinode.report.pdf import to_pictures

    save(plot_loads(load_case(STARTER)), IMAGES / "gallery_loads.png")
    pages = to_pictures(make_report(STARTER)[0], 60)
    sheets = [Image.open(io.BytesIO(page)).convert("RGB") for page in pages]
    width, height = sheets[0].size
    whole = Image.new("RGB", (3 * width + 2, height), GREY)
    for k, number in enumerate((0, 3, 4)):
        whole.paste(sheets[number], (k * (width + 1), 0))
    whole.save(IMAGES / "gallery_report.png", optimize=True)


def gallery_paper() -> None:
    """Draw four of the figures of the paper on the reconstructed vehicle."""
    from antinode.paper.comparison import compare
    from antinode.paper.gallery import PLATES
    from antinode.paper.scene import Scene

    scene = Scene(compare())
    for plate in PLATES:
        if plate.name in PAPER:
            save(plate.draw(scene)[0], IMAGES / f"gallery_{plate.name}.png")


PAPER = ("figure_03_vehicle", "figure_07_cavity", "figure_09_characteristic", "differences")
MAKERS = (
    starter_modes,
    ruler_modes,
    howto,
    end_forces,
    stability_loci,
    ziegler,
    equipment,
    sweeps,
    tornado,
    speed_sweep,
    literal_methods,
    conventions,
    gallery,
    gallery_paper,
)


def main() -> None:
    """Make the images that are named, or all."""
    IMAGES.mkdir(exist_ok=True)
    wanted = sys.argv[1:]
    for make in MAKERS:
        if not wanted or make.__name__ in wanted:
            with styled():
                make()


if __name__ == "__main__":
    main()

"""The figure of a sweep: frequency against the input that varies, each mode in its own colour.

Equipment that must not be excited is a shaded band; excitation lines are dashed, and marked where
they cross a mode.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import numpy.typing as npt

from antinode.arrays import Array
from antinode.errors import InputError
from antinode.show.figures import PALETTE, STYLE, pyplot
from antinode.study.design.file import Study
from antinode.text import nearest

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_MOST_LINES = 12  # of one mode, where further inputs vary
_MOST_POINTS = 5_000  # of a cloud
_MOST_NAMED = 12
_WIDE = 4.0  # range of frequencies from which the axis is logarithmic
_ROOM = 1.4  # above the highest frequency, for the name of the band
_GREY = "#5A5A5A"


class Crossing(NamedTuple):
    """Where an excitation meets a mode."""

    x: float
    hz: float
    mode: int


def plot_sweep(study: Study, dataset: xarray.Dataset) -> Figure:
    """Draw the frequencies of a sweep against one of its inputs."""
    if "frequency_hz" not in dataset:
        raise InputError("a figure needs frequency_hz among the outputs")
    plt, name = pyplot(), _axis_name(study, dataset)
    tracked = "tracked_frequency_hz" in dataset
    hz = np.asarray(dataset["tracked_frequency_hz" if tracked else "frequency_hz"])
    x, unit = np.asarray(dataset[name]), str(dataset[name].attrs.get("units", "1"))
    with plt.rc_context(STYLE):
        figure: Figure
        figure, axes, below = _panels(plt, with_change=tracked)
        lines = _lines(dataset, name)
        _band(axes, study, hz)
        for k in range(hz.shape[1]):
            colour = PALETTE[k % len(PALETTE)]
            _draw_mode(axes, x, hz[:, k], lines, colour, ordered=tracked)
            if below is not None:
                _draw_mode(below, x, _change(hz[:, k]), lines, colour, ordered=True)
        _mark_doubts(axes, dataset, x, hz, lines)
        _name_modes(axes, x, hz, [str(m) for m in dataset["mode"].values])
        _excitations(axes, study, x, hz, lines if tracked else [])
        _scale(axes, hz)
        axes.set_xlim(*_padded(x))
        last = axes if below is None else below
        last.set_xlabel(f"{name.replace('_', ' ')}{'' if unit == '1' else f' [{unit}]'}")
        axes.set_ylabel("frequency [Hz]")
        axes.set_title(_title(study, dataset, name, lines), loc="left")
    return figure


def _panels(plt: Any, *, with_change: bool) -> tuple[Figure, Axes, Axes | None]:
    """Return a panel for frequencies, and one below for their change from the first case."""
    if not with_change:
        figure, axes = plt.subplots(figsize=(8.0, 5.0), layout="constrained")
        return figure, axes, None
    figure, (axes, below) = plt.subplots(
        2, 1, figsize=(8.0, 6.4), sharex=True, layout="constrained", height_ratios=(2, 1)
    )
    below.set_ylabel("change [%]")
    below.set_title("change from the first case", loc="left")
    return figure, axes, below


def _change(hz: Array) -> Array:
    """Return the change of frequencies from the first one that is known [%]."""
    known = np.flatnonzero(np.isfinite(hz) & (hz > 0))
    return 100 * (hz / hz[known[0]] - 1) if len(known) else np.full(len(hz), np.nan)


def _axis_name(study: Study, dataset: xarray.Dataset) -> str:
    names = [str(n) for n in dataset.attrs["input_names"]]
    if study.figure.x is None:
        return "time" if "time" in names else names[0]
    if study.figure.x not in names:
        raise InputError(
            f"figure.x = '{study.figure.x}' is no input; {nearest(study.figure.x, names)}"
        )
    return study.figure.x


def _lines(dataset: xarray.Dataset, name: str) -> list[npt.NDArray[np.int64]]:
    """Return the cases of each line: those that differ in nothing but the input along the axis."""
    cases = np.arange(dataset.sizes["case"])
    if dataset.attrs["design"] != "grid":
        return [cases]
    axis = list(dataset.attrs["input_names"]).index(name)
    table = np.moveaxis(cases.reshape(list(dataset.attrs["shape"])), axis, -1)
    rows = table.reshape(-1, table.shape[-1])
    keep = np.unique(np.linspace(0, len(rows) - 1, _MOST_LINES).astype(int))
    return list(rows[keep])


def _draw_mode(
    axes: Axes,
    x: Array,
    hz: Array,
    lines: list[npt.NDArray[np.int64]],
    colour: str,
    *,
    ordered: bool,
) -> None:
    if not ordered:
        every = max(1, len(x) // _MOST_POINTS)
        axes.plot(x[::every], hz[::every], ".", color=colour, markersize=2.5, alpha=0.5)
        return
    for number, line in enumerate(lines):
        few = len(line) <= 40
        axes.plot(
            x[line],
            hz[line],
            "o-" if few else "-",
            color=colour,
            markersize=2.5,
            alpha=1.0 if number == 0 else 0.45,
            linewidth=1.6 if number == 0 else 0.9,
        )


def _mark_doubts(
    axes: Axes,
    dataset: xarray.Dataset,
    x: Array,
    hz: Array,
    lines: list[npt.NDArray[np.int64]],
) -> None:
    """Cross out where a tracked mode may have become another one."""
    if "tracked_doubtful" not in dataset:
        return
    drawn = np.concatenate(lines)
    case, track = np.nonzero(np.asarray(dataset["tracked_doubtful"])[drawn])
    if not len(case):
        return
    axes.plot(
        x[drawn[case]],
        hz[drawn[case], track],
        "x",
        color="#111111",
        markersize=6,
        zorder=6,
        label="shape unlike its neighbour's: the mode may be another",
    )
    axes.legend(loc="lower right", fontsize=7.5)


def _name_modes(axes: Axes, x: Array, hz: Array, names: list[str]) -> None:
    """Write the name of each mode at its right end, where there is room."""
    ends = []
    for k, name in enumerate(names[:_MOST_NAMED]):
        known = np.flatnonzero(np.isfinite(hz[:, k]))
        if len(known):
            last = known[np.argmax(x[known])]
            ends.append((float(x[last]), float(hz[last, k]), name, PALETTE[k % len(PALETTE)]))
    for right, height, name, colour in ends:
        axes.annotate(
            name,
            (right, height),
            xytext=(6, 0),
            textcoords="offset points",
            color=colour,
            fontsize=8,
            va="center",
            annotation_clip=False,
        )


def _band(axes: Axes, study: Study, hz: Array) -> None:
    """Shade the band of equipment, as far as it is in sight."""
    if study.figure.band is None or not np.any(np.isfinite(hz)):
        return
    low, high = study.figure.band
    top = float(np.nanmax(hz)) * _ROOM
    if low > top:
        return
    axes.axhspan(low, min(high, top), color="#F5D76E", alpha=0.22, linewidth=0, zorder=0)
    axes.annotate(
        f"equipment, {low:g} to {high:g} Hz",
        (0.01, min(high, top)),
        xycoords=("axes fraction", "data"),
        xytext=(2, -10),
        textcoords="offset points",
        fontsize=7.5,
        color="#8A6D00",
    )


def _excitations(
    axes: Axes, study: Study, x: Array, hz: Array, lines: list[npt.NDArray[np.int64]]
) -> None:
    along = np.linspace(float(x.min()), float(x.max()), 200)
    for given in study.figure.excitations:
        axes.plot(along, given.frequency + given.slope * along, "--", color=_GREY, linewidth=1.1)
        end = given.frequency + given.slope * along[-1]
        axes.annotate(
            given.name,
            (along[-1], end),
            xytext=(-4, 5),
            textcoords="offset points",
            ha="right",
            fontsize=8,
            color=_GREY,
        )
        found = [
            c for line in lines for c in crossings(x[line], hz[line], given.frequency, given.slope)
        ]
        if found:
            axes.plot(
                [c.x for c in found],
                [c.hz for c in found],
                "o",
                markerfacecolor="white",
                markeredgecolor="#111111",
                markersize=7,
                zorder=5,
            )


def crossings(x: Array, hz: Array, frequency: float, slope: float) -> list[Crossing]:
    """Return where a line ``frequency + slope x`` crosses each mode, linear between cases.

    Parameters
    ----------
    x : array, shape (cases,)
    hz : array, shape (cases, modes)
    frequency, slope : float
    """
    found = []
    gap = hz - (frequency + slope * x)[:, None]
    for k in range(hz.shape[1]):
        a, b = gap[:-1, k], gap[1:, k]
        for i in np.flatnonzero(np.isfinite(a) & np.isfinite(b) & (a * b <= 0) & (a != b)):
            t = a[i] / (a[i] - b[i])
            found.append(
                Crossing(
                    float(x[i] + t * (x[i + 1] - x[i])),
                    float(hz[i, k] + t * (hz[i + 1, k] - hz[i, k])),
                    k,
                )
            )
    return found


def _scale(axes: Axes, hz: Array) -> None:
    known = hz[np.isfinite(hz) & (hz > 0)]
    if not known.size:
        return
    low, high = float(known.min()), float(known.max())
    if high > _WIDE * low and low > high / 1e3:
        axes.set_yscale("log")
        axes.set_ylim(low / 1.15, high * _ROOM)
        from matplotlib.ticker import LogLocator, ScalarFormatter

        axes.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        axes.yaxis.set_major_formatter(ScalarFormatter())
        axes.yaxis.set_minor_locator(LogLocator(subs=()))
    else:
        axes.set_ylim(0, high * _ROOM)


def _padded(x: Array) -> tuple[float, float]:
    """Return the limits of the axis, with room for the names at its right end."""
    low, high = float(x.min()), float(x.max())
    size = (high - low) or max(abs(high), 1.0) * 0.1
    return low - 0.02 * size, high + 0.16 * size


def _title(
    study: Study, dataset: xarray.Dataset, name: str, lines: list[npt.NDArray[np.int64]]
) -> str:
    title = study.name or f"{study.subject.name}: frequencies over {name.replace('_', ' ')}"
    others: list[Any] = [n for n in dataset.attrs["input_names"] if n != name]
    return f"{title} ({len(lines)} lines: {', '.join(others[:3])})" if len(lines) > 1 else title

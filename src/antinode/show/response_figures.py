"""Figures of responses, as a design review takes them: curves, limits and what exceeds them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from .response_table import JUDGED, error_words, scale_of
from .style import GREY, INK, PALETTE, WIDTH, styled

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_HEIGHT = 2.5  # of a panel [in]
_MOST_NAMED = 8  # modes that are named above a panel
LIMIT, OVER = "#B91C1C", "#FCA5A5"


def plot_response(result: Any) -> Figure:
    """Draw a response of any kind, a panel for each output, and one for each unit of equipment."""
    return _DRAWN[result.kind](result)


def _panels(number: int, title: str) -> tuple[Figure, list[Axes]]:
    with styled() as plt:
        figure, axes = plt.subplots(
            number, 1, figsize=(WIDTH, _HEIGHT * number + 0.5), squeeze=False, layout="constrained"
        )
        figure.suptitle(title)
        return figure, [row[0] for row in axes]


def _draw_harmonic(result: Any) -> Figure:
    with styled():
        equipment = list(result.verdicts)
        figure, axes = _panels(len(result.outputs) + len(equipment), _title(result))
        for verdict, panel in zip(equipment, axes[len(result.outputs) :], strict=True):
            _draw_limit(panel, verdict, 1)
        for row, (output, panel) in enumerate(zip(result.outputs, axes, strict=False)):
            size = scale_of(output.unit)
            amplitude = np.abs(result.values[row]) / size.factor
            peaks = [(p.frequency_hz, p.size / size.factor) for p in result.peaks[row]]
            f, y = _joined(result.frequency_hz, amplitude, peaks)
            panel.plot(f, y, color=PALETTE[0], zorder=3)
            _mark_peaks(panel, peaks)
            _name_modes(panel, result, row == 0)
            _frequency_axes(panel, f"{output.name} [{size.unit}]", f)
        return figure


def _draw_random(result: Any) -> Figure:
    equipment = list(result.verdicts)
    number = len(result.outputs) + len(equipment) + (result.envelope is not None)
    with styled():
        figure, axes = _panels(number, _title(result))
        for row, output in enumerate(result.outputs):
            size = scale_of(output.unit)
            own = result.statistics[row]
            peaks = [(p.frequency_hz, p.size / size.factor**2) for p in result.peaks[row]]
            f, y = _joined(result.frequency_hz, result.psd[row] / size.factor**2, peaks)
            label = f"{own.rms / size.factor:.4g} {size.unit} rms"
            axes[row].plot(f, y, color=PALETTE[0], label=label, zorder=3)
            axes[row].legend(loc="best")
            _name_modes(axes[row], result, row == 0)
            _frequency_axes(axes[row], f"{output.name}\n[{_squared(size.unit)}/Hz]", f)
        for verdict, panel in zip(equipment, axes[len(result.outputs) :], strict=False):
            _draw_limit(panel, verdict, 2)
        if result.envelope is not None:
            _draw_envelope(axes[-1], result.envelope)
        return figure


def _draw_limit(panel: Axes, verdict: Any, power: int) -> None:
    """Draw what equipment feels under what it may feel, and mark where it is more."""
    factor = scale_of("m/s^2").factor ** power
    f, felt, allowed = (np.asarray(v) for v in verdict.curve)
    felt, allowed = felt / factor, allowed / factor
    unit = "g" if power == 1 else "g$^2$/Hz"
    panel.plot(f, allowed, color=LIMIT, linewidth=1.4, label="allowed", zorder=4)
    panel.plot(f, felt, color=PALETTE[0], label="felt", zorder=3)
    panel.fill_between(f, allowed, np.maximum(felt, allowed), color=OVER, alpha=0.8, zorder=2)
    worst = verdict.frequency_hz
    panel.plot([worst], [verdict.felt / factor], "o", color=LIMIT, ms=4, zorder=5)
    panel.legend(loc="best")
    words = JUDGED[verdict.verdict]
    error = error_words(verdict.error_db)
    margin = verdict.margin_words + (f" +- {error} dB" if error else "")
    panel.set_title(
        f"{verdict.name}, x = {verdict.x:.4g} m: {words}, margin {margin} at "
        f"{worst:.4g} Hz ({verdict.mode}{', ' + verdict.force if verdict.force else ''})",
        color=INK if verdict.passed else LIMIT,
        fontsize="medium",
    )
    _frequency_axes(panel, f"acceleration [{unit}]", f)


def _draw_envelope(panel: Axes, envelope: dict[str, Any]) -> None:
    x, moment = envelope["x"], envelope["bending_moment_rms"]
    panel.plot(x, moment, color=PALETTE[1], label="bending moment")
    panel.set(xlabel="x [m]", ylabel="moment, rms [N m]", xlim=(x[0], x[-1]))
    panel.set_ylim(bottom=0)
    other = panel.twinx()
    size = scale_of("m/s^2")
    values = envelope["acceleration_rms"] / size.factor
    other.plot(x, values, color=PALETTE[0], label="acceleration", linestyle="--")
    other.set_ylabel("acceleration, rms [g]")
    other.set_ylim(bottom=0)
    other.grid(visible=False)
    lines = [*panel.get_lines(), *other.get_lines()]
    panel.legend(lines, [str(line.get_label()) for line in lines], loc="best")


def _draw_transient(result: Any) -> Figure:
    with styled():
        figure, axes = _panels(len(result.outputs), _title(result))
        for row, (output, panel) in enumerate(zip(result.outputs, axes, strict=True)):
            size = scale_of(output.unit)
            panel.plot(result.time_s, result.values[row] / size.factor, color=PALETTE[0])
            panel.axhline(0, color=GREY, linewidth=0.6)
            time, value = result.largest[row]
            panel.plot([time], [value / size.factor], "o", color=LIMIT, ms=4)
            panel.set(ylabel=f"{output.name}\n[{size.unit}]", xlabel="time [s]")
            panel.set_xlim(result.time_s[0], result.time_s[-1])
        return figure


def _draw_shock(result: Any) -> Figure:
    equipment = list(result.verdicts)
    with styled():
        figure, axes = _panels(len(result.outputs) + len(equipment), _title(result))
        for row, output in enumerate(result.outputs):
            size = scale_of(output.unit)
            srs = result.srs[row] / size.factor
            axes[row].plot(result.frequency_hz, srs, color=PALETTE[0])
            words = f"SRS of {output.name}\n[{size.unit}], Q = {result.q:g}"
            _frequency_axes(axes[row], words, result.frequency_hz)
        for verdict, panel in zip(equipment, axes[len(result.outputs) :], strict=True):
            _draw_limit(panel, verdict, 1)
        return figure


def _title(result: Any) -> str:
    return f"{result.title}: {result.kind} response (damping: {result.damping.describe()})"


def _squared(unit: str) -> str:
    return f"{unit}$^2$" if " " not in unit and "/" not in unit else f"({unit})$^2$"


def _joined(f: Any, y: Any, peaks: list[tuple[float, float]]) -> tuple[Any, Any]:
    """Return a curve with its peaks among the points."""
    places = np.concatenate([f, [p[0] for p in peaks]])
    values = np.concatenate([y, [p[1] for p in peaks]])
    order = np.argsort(places, kind="stable")
    return places[order], values[order]


def _mark_peaks(panel: Axes, peaks: list[tuple[float, float]]) -> None:
    highest = sorted(peaks, key=lambda p: -p[1])[:5]
    panel.plot([p[0] for p in highest], [p[1] for p in highest], "o", ms=3.5, color=LIMIT, zorder=4)


def _name_modes(panel: Axes, result: Any, names: bool) -> None:
    """Draw a thin line at each natural frequency, named above the first panel."""
    low, high = result.frequency_hz[0], result.frequency_hz[-1]
    rows = [
        (f, name)
        for own in result.modes
        for name, f in zip(own.names, own.frequency_hz, strict=True)
        if low < f < high
    ][:_MOST_NAMED]
    for f, name in rows:
        panel.axvline(f, color=GREY, linewidth=0.5, linestyle=(0, (4, 3)), zorder=1)
        if names:
            panel.text(
                f, 1.02, name.split()[-1], transform=panel.get_xaxis_transform(), color=GREY,
                ha="center", va="bottom", fontsize="small",
            )  # fmt: skip


def _frequency_axes(panel: Axes, label: str, f: Any) -> None:
    panel.set(xscale="log", yscale="log", xlabel="frequency [Hz]", ylabel=label)
    panel.set_xlim(f[0], f[-1])


_DRAWN = {
    "harmonic": _draw_harmonic,
    "random": _draw_random,
    "transient": _draw_transient,
    "shock": _draw_shock,
}

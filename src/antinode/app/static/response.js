// A response over frequency, both axes logarithmic, its peaks marked and listed below.
import { FONT, html, rounded } from "./theme.js";
import { axis, chart, label, tooltip, xAxis } from "./charts.js";

export function response(element) {
  const plot = element.appendChild(html("div", "an-plot"));
  const list = element.appendChild(html("div", "an-peaks"));
  Object.assign(list, { tabIndex: 0, role: "region", ariaLabel: "Peaks" }); // it may scroll
  let last = null;
  const power = (value) => (value >= 0.01 && value < 1e4 ? String(value) : value.toExponential(0).replace("e+", "e"));
  const log = (t, ends) => ({ type: "log", splitNumber: 4, axisLabel: { ...label(t), formatter: power }, ...ends });
  const lines = (data, t) => [
    { id: "curve", type: "line", symbol: "none", lineStyle: { color: t.accent, width: 1.6 }, data: data.points },
    {
      id: "peaks",
      type: "scatter",
      symbolSize: 7,
      itemStyle: { color: t.card, borderColor: t.series[1], borderWidth: 2 },
      tooltip: { show: false },
      data: data.peaks.map((p) => [p.hz, p.size]),
    },
    { id: "kept", name: "snapshot", type: "line", symbol: "none", lineStyle: { color: t.muted, width: 1.2, type: "dotted" }, tooltip: { show: false }, data: data.kept ?? [] },
  ];
  // What acts and what is seen, in one line where there is room for it, else in two.
  const words = (data) => {
    const [acts, seen] = data.title.split(": ");
    const line = `${acts}: ${seen} [${data.unit}]`;
    return 5.6 * line.length < plot.clientWidth - 56 ? [line] : [`${acts}:`, `${seen} [${data.unit}]`];
  };
  const full = (data, t) => ({
    title: { text: words(data).join("\n"), left: 46, top: 2, padding: 0, textStyle: { color: t.muted, fontSize: 11, lineHeight: 13, fontWeight: 400, fontFamily: FONT } },
    grid: { left: 46, right: 14, top: 13 * words(data).length + 13, bottom: 34 },
    xAxis: xAxis(t, "frequency [Hz]", log(t, { min: data.low, max: data.high, nameGap: 20 })),
    yAxis: axis(t, "", log(t, {})),
    tooltip: tooltip(t, (points) => {
      const p = points.find((q) => q.seriesId === "curve") ?? points[0];
      return `${rounded(p.value[0])} Hz<br><b>${rounded(p.value[1])}</b> ${data.unit}, phase ${rounded(p.value[2])}°`;
    }),
    series: lines(data, t),
  });
  const it = chart(plot, full, (data, t) => ({ series: lines(data, t).map((s) => ({ id: s.id, data: s.data })) }));
  const cells = (data) => data.peaks.map((p) => [`${p.hz}`, p.size >= 1e-3 && p.size < 1e6 ? `${p.size}` : p.size.toExponential(4).replace("e+", "e"), p.error, p.mode]);

  function tell(data) {
    const parts = data.notes.map((note) => html("p", "an-hint", note));
    if (data.peaks?.length) {
      const table = html("table", "an-sheet");
      const head = html("tr");
      for (const text of heads(data)) {
        const cell = html("th", "", text);
        cell.scope = "col";
        head.append(cell);
      }
      const top = html("thead");
      top.append(head);
      const rows = html("tbody");
      for (const row of cells(data)) {
        const line = html("tr");
        line.append(...row.map((text) => html("td", "", text)));
        rows.append(line);
      }
      table.append(top, rows);
      parts.unshift(table);
    }
    list.classList.toggle("an-quick", Boolean(data.quick));
    list.replaceChildren(...parts);
  }
  const heads = (data) => ["peak [Hz]", `[${data.unit}]`, "±", "mode"];

  return {
    instance: it.instance,
    enlarged: (on) => it.enlarged(on),
    text: () => (last?.points ? [heads(last), ...cells(last), ...last.notes.map((n) => [n])].map((row) => row.join("\t")).join("\n") : ""),
    show(data) {
      last = data;
      plot.classList.toggle("an-none", !data.points);
      tell(data);
      if (!data.points) return;
      it.resize();
      it.show({ ...data, signature: JSON.stringify([data.title, data.unit, data.low, data.high]) });
    },
    retheme: () => last?.points && it.retheme(),
    resize: () => (it.resize(), it.draw(true)),
    destroy: () => it.destroy(),
  };
}

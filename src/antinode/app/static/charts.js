// Line charts: internal forces, mode shapes, the characteristic function, a curve over one input.
import { echarts } from "nicegui-echart";
import { FONT, rounded, seriesColour, theme } from "./theme.js";

export const label = (t) => ({ color: t.muted, fontSize: 11, fontFamily: FONT, hideOverlap: true });

export function axis(t, name, more = {}) {
  return {
    type: "value",
    name,
    nameLocation: "end",
    nameTextStyle: { color: t.muted, fontSize: 11, fontFamily: FONT },
    axisLine: { show: false },
    axisTick: { show: false },
    axisLabel: { ...label(t), formatter: rounded },
    splitLine: { lineStyle: { color: t.line } },
    ...more,
  };
}

export function xAxis(t, name, more = {}) {
  return axis(t, name, {
    nameLocation: "middle",
    nameGap: 23,
    axisLine: { show: true, onZero: false, lineStyle: { color: t.line } },
    splitLine: { show: false },
    ...more,
  });
}

export function tooltip(t, format) {
  return {
    trigger: "axis",
    confine: true,
    transitionDuration: 0,
    backgroundColor: t.card,
    borderColor: t.line,
    padding: [4, 8],
    textStyle: { color: t.text, fontSize: 11, fontFamily: FONT },
    axisPointer: { lineStyle: { color: t.muted, type: "dashed" } },
    formatter: format,
  };
}

// A chart that draws all of its options from its last data: `options(data, theme)`. Where it fills
// the page the wheel zooms, a drag moves what is zoomed, and a double click shows all again.
export function chart(element, options, quick) {
  const instance = echarts.init(element);
  let last = null;
  let signature = "";
  let large = false;
  const zoom = () => {
    const axes = { xAxisIndex: "all", yAxisIndex: [], filterMode: "none" };
    if (large) instance.setOption({ dataZoom: [{ type: "inside", ...axes }] });
  };
  const draw = (fresh) => {
    if (!last) return;
    const t = theme();
    const drawn = quick && !fresh ? quick(last, t) : null;
    if (drawn) instance.setOption(drawn, { lazyUpdate: false });
    else {
      instance.setOption({ animation: false, textStyle: { fontFamily: FONT }, ...options(last, t) }, true);
      zoom();
    }
  };
  instance.getZr().on("dblclick", () => instance.dispatchAction({ type: "dataZoom", start: 0, end: 100 }));
  return {
    instance,
    get data() {
      return last;
    },
    show(data) {
      last = data;
      const now = data.signature ?? "";
      draw(now !== signature || signature === "");
      signature = now;
    },
    draw,
    enlarged(on) {
      large = on;
      draw(true);
    },
    retheme: () => draw(true),
    resize: () => instance.resize(),
    destroy: () => instance.dispose(),
  };
}

// Small graphs above one another over the length, each with one line or several.
export function forces(element) {
  const tall = (data) => Boolean(data.heading);
  const layout = (data) => {
    const [above, count] = [tall(data) ? 18 : 0, data.curves.length];
    const room = (element.clientHeight - 50 - above) / count;
    return data.curves.map((_, k) => ({ left: 58, right: 12, top: above + 28 + k * room, height: Math.max(14, room - 28) }));
  };
  const lines = (data) => data.curves.flatMap((c, k) => c.lines.map((line, n) => ({ ...line, graph: k, colour: c.lines.length > 1 ? n + 1 : k + 1, filled: c.lines.length === 1, unit: c.unit, of: c.name })));
  const series = (data, t) =>
    lines(data).map((line) => ({
      name: line.name || line.of,
      type: "line",
      xAxisIndex: line.graph,
      yAxisIndex: line.graph,
      symbol: "none",
      lineStyle: { width: 1.6, color: seriesColour(t, line.colour) },
      itemStyle: { color: seriesColour(t, line.colour) },
      ...(line.filled ? { areaStyle: { color: seriesColour(t, line.colour), opacity: 0.13 } } : {}),
      data: line.points,
    }));
  const text = (t, more) => ({ textStyle: { color: t.muted, fontSize: 11, fontWeight: 400, fontFamily: FONT, overflow: "truncate", ...more } });
  const titles = (data, t) => {
    const places = layout(data);
    const width = Math.max(60, element.clientWidth - 70 - 46);
    const found = data.curves.map((c, k) => {
      const rich = Object.fromEntries(c.lines.map((_, n) => [`c${n}`, { color: seriesColour(t, n + 1), fontSize: 11, fontWeight: 500 }]));
      const told = c.lines.length > 1 ? c.lines.map((line, n) => `{c${n}|${line.label}}`).join("  ") : c.title;
      return { text: `${c.name}  ${told}`, left: 58, top: places[k].top - 20, padding: 0, ...text(t, { width, rich }) };
    });
    return tall(data) ? [...found, { text: data.heading, left: 8, top: 3, padding: 0, ...text(t, { color: t.text, lineHeight: 14, width: element.clientWidth - 16 }) }] : found;
  };
  const ends = (c) => ({ min: c.lines[0].points[0][0], max: c.lines[0].points.at(-1)[0] });
  const full = (data, t) => ({
    grid: layout(data),
    title: titles(data, t),
    xAxis: data.curves.map((c, k) => {
      const lowest = k === data.curves.length - 1;
      return xAxis(t, lowest ? `x from the ${data.x.origin} [${data.x.unit}]` : "", {
        ...ends(c),
        gridIndex: k,
        axisLabel: { ...label(t), show: lowest, formatter: rounded },
        nameGap: 22,
      });
    }),
    yAxis: data.curves.map((c, k) => axis(t, "", { ...(c.unit ? {} : { min: -1, max: 1, interval: 1 }), gridIndex: k, splitNumber: layout(data)[k].height < 60 ? 1 : 2, axisLabel: { ...label(t), formatter: rounded } })),
    graphic: data.curves.map((c, k) => ({
      type: "text",
      right: 12,
      top: layout(data)[k].top - 19,
      style: { text: c.unit ? `[${c.unit}]` : "", fill: t.muted, font: `11px ${FONT}` },
    })),
    axisPointer: { link: [{ xAxisIndex: "all" }] },
    tooltip: tooltip(t, (points) => {
      const every = lines(data);
      const rows = points.map((p) => `${p.marker} ${p.seriesName} = <b>${rounded(p.value[1])}</b> ${every[p.seriesIndex]?.unit ?? ""}`);
      return [`x = ${rounded(points[0].value[0])} ${data.x.unit}`, ...new Set(rows)].join("<br>");
    }),
    series: series(data, t),
  });
  const it = chart(element, full, (data, t) => ({ title: titles(data, t), series: series(data, t).map((s) => ({ data: s.data })) }));
  const rows = () => lines(it.data).flatMap((l) => l.points.map(([x, y]) => [l.name || l.of, x, y, l.unit]));
  return {
    ...it,
    show: (d) => (d.curves ? it.show({ ...d, signature: sign(d) }) : null),
    resize: () => (it.resize(), it.draw(true)),
    text: () => (it.data ? tabbed(["curve", `x [${it.data.x.unit}]`, "value", "unit"], rows()) : ""),
  };
}
const sign = (d) => JSON.stringify([d.x.unit, d.curves.map((c) => [c.name, c.unit, c.lines.map((l) => l.name), c.lines[0].points[0][0], c.lines[0].points.at(-1)[0]])]);

// Rows with tabs between their cells, as spreadsheets take them.
export const tabbed = (heads, rows) => [heads, ...rows].map((row) => row.join("\t")).join("\n");

// Lines over the same places side by side: one row a place.
const wide = (heads, curves) => tabbed(heads, (curves[0] ?? []).map(([x], k) => [x, ...curves.map((points) => points[k]?.[1] ?? "")]));

export function modes(element) {
  let playing = false;
  let frame = 0;
  let start = 0;
  const reduced = window.matchMedia("(prefers-reduced-motion: reduce)");
  const wave = (points, k) => {
    if (!playing) return points;
    const time = (performance.now() - start) / 1000;
    const angle = 2 * Math.PI * 0.5 * time * (1 + 0.22 * k);
    const [real, imaginary] = [Math.cos(angle), Math.sin(angle)];
    return points.map(([x, y, behind]) => [x, y * real - (behind ?? 0) * imaginary]);
  };
  const lines = (data, t) =>
    data.curves.map((c, k) => ({
      id: `mode ${c.number}`,
      name: `${c.number}`,
      type: "line",
      symbol: "none",
      lineStyle: { width: 1.8, color: seriesColour(t, c.number), type: c.number > 6 ? "dashed" : "solid" },
      itemStyle: { color: seriesColour(t, c.number) },
      data: wave(c.points, k),
    }));
  const kept = (data, t) =>
    data.kept.map((c) => ({
      id: `kept ${c.number}`,
      name: `${c.number}, snapshot`,
      type: "line",
      symbol: "none",
      lineStyle: { width: 1.2, color: seriesColour(t, c.number), type: "dotted", opacity: 0.8 },
      itemStyle: { color: seriesColour(t, c.number) },
      data: c.points,
    }));
  const full = (data, t) => ({
    grid: { left: 42, right: 12, top: 26, bottom: 36 },
    legend: {
      data: data.curves.map((c) => `${c.number}`),
      top: 0,
      left: 34,
      icon: "roundRect",
      itemWidth: 14,
      itemHeight: 3,
      itemGap: 10,
      textStyle: { color: t.muted, fontSize: 11, fontFamily: FONT },
      selectedMode: false,
      formatter: (name) => (data.curves.length > 3 ? name : `${name}: ${data.curves.find((c) => `${c.number}` === name)?.label ?? ""}`),
    },
    xAxis: xAxis(t, `x from the ${data.origin} [${data.unit}]`, {
      min: data.curves[0]?.points[0][0] ?? 0,
      max: data.curves[0]?.points[data.curves[0].points.length - 1][0] ?? 1,
    }),
    yAxis: axis(t, "", { min: -1, max: 1, interval: 0.5 }),
    tooltip: tooltip(t, (points) =>
      [`x = ${rounded(points[0].value[0])} ${data.unit}`]
        .concat(points.map((p) => `${p.marker} mode ${p.seriesName}: <b>${rounded(p.value[1])}</b>`))
        .join("<br>"),
    ),
    series: [...lines(data, t), ...kept(data, t)],
  });
  const it = chart(element, full, (data, t) => ({
    legend: full(data, t).legend,
    series: [...lines(data, t), ...kept(data, t)].map((s) => ({ id: s.id, data: s.data })),
  }));
  const step = () => {
    if (!playing) return;
    if (it.data && !document.hidden)
      it.instance.setOption({ series: it.data.curves.map((c, k) => ({ id: `mode ${c.number}`, data: wave(c.points, k) })) });
    frame = setTimeout(() => requestAnimationFrame(step), 30);
  };
  return {
    ...it,
    text: () => (it.data ? wide([`x [${it.data.unit}]`, ...it.data.curves.map((c) => `mode ${c.number}: ${it.data.component}`)], it.data.curves.map((c) => c.points)) : ""),
    show(data) {
      const key = [data.unit, data.component, data.curves.map((c) => c.number), data.kept.map((c) => c.number)];
      it.show({ ...data, signature: JSON.stringify(key) });
    },
    play(on) {
      playing = on && !(reduced.matches && on === "auto");
      start = performance.now();
      clearTimeout(frame);
      if (playing) step();
      else it.draw(true);
    },
  };
}

export function characteristic(element) {
  const note = (data, t) => ({ text: data.note, right: 14, top: 2, padding: [2, 0], textStyle: { color: t.muted, fontSize: 11, fontWeight: 400, fontFamily: FONT } });
  const full = (data, t) => ({
    title: note(data, t),
    grid: { left: 26, right: 14, top: data.note ? 22 : 10, bottom: 36 },
    xAxis: xAxis(t, "frequency [Hz]", { min: 0, max: data.points[data.points.length - 1][0], axisLabel: { ...label(t), formatter: rounded, showMaxLabel: false } }),
    yAxis: axis(t, "", { min: -1.08, max: 1.08, interval: 1.08, splitLine: { show: false }, axisLabel: { ...label(t), formatter: (v) => (Math.abs(v) < 0.1 ? "0" : "") } }),
    tooltip: tooltip(t, (points) => `${rounded(points[0].value[0])} Hz`),
    series: [
      {
        id: "function",
        type: "line",
        symbol: "none",
        lineStyle: { color: t.accent, width: 1.6 },
        data: data.points,
        markLine: { silent: true, symbol: "none", label: { show: false }, lineStyle: { color: t.muted, type: "solid", width: 1 }, data: [{ yAxis: 0 }] },
      },
      {
        id: "roots",
        type: "scatter",
        symbolSize: 8,
        itemStyle: { color: t.card, borderColor: t.series[1], borderWidth: 2 },
        tooltip: { trigger: "item", formatter: (p) => `root ${p.dataIndex + 1 + data.divergent}: <b>${p.value[0]}</b> Hz` },
        data: data.roots.map((f) => [f, 0]),
      },
    ],
  });
  const quick = (data, t) => ({
    title: note(data, t),
    xAxis: { max: data.points[data.points.length - 1][0] },
    series: full(data, t).series.map((s) => ({ id: s.id, data: s.data, tooltip: s.tooltip })),
  });
  const it = chart(element, full, quick);
  return {
    ...it,
    show: (data) => it.show({ ...data, signature: "one" }),
    text: () => (it.data ? tabbed(["frequency [Hz]", "function", "root"], [...it.data.points.map(([f, y]) => [f, y, ""]), ...it.data.roots.map((f, k) => [f, 0, k + 1 + it.data.divergent])]) : ""),
  };
}

export function curve(element) {
  let cursor = null;
  const lines = (data, t) =>
    data.lines.map((points, k) => ({
      id: `mode ${k + 1}`,
      name: `mode ${k + 1}`,
      type: "line",
      symbol: "none",
      smooth: 0.2,
      smoothMonotone: "x",
      lineStyle: { color: seriesColour(t, k + 1), width: 1.8, type: k > 5 ? "dashed" : "solid" },
      itemStyle: { color: seriesColour(t, k + 1) },
      data: points,
    }));
  const marks = (t) => ({
    id: "now",
    type: "scatter",
    symbolSize: 7,
    z: 5,
    itemStyle: { color: t.card, borderColor: t.text, borderWidth: 1.5 },
    tooltip: { show: false },
    data: cursor ? cursor.hertz.map((f) => [cursor.value, f]) : [],
    markLine: {
      silent: true,
      symbol: "none",
      animation: false,
      label: { show: false },
      lineStyle: { color: t.text, type: "solid", width: 1, opacity: 0.6 },
      data: cursor ? [{ xAxis: cursor.value }] : [],
    },
  });
  const words = (t) => ({ color: t.muted, fontSize: 12, lineHeight: 17, fontWeight: 400, fontFamily: FONT, width: element.clientWidth - 20, overflow: "break" });
  const full = (data, t) => (data.said ? { title: { text: data.said, left: 10, top: 10, textStyle: words(t) } } : drawn(data, t));
  const drawn = (data, t) => ({
    grid: { left: 42, right: 16, top: 12, bottom: 36 },
    xAxis: xAxis(t, `${data.label}${data.unit ? ` [${data.unit}]` : ""}`, { min: data.low, max: data.high, axisLabel: { ...label(t), formatter: rounded } }),
    yAxis: axis(t, "", { min: 0, splitNumber: 4 }),
    tooltip: tooltip(t, (points) =>
      [`${data.label} = ${rounded(points[0].value[0])} ${data.unit}`]
        .concat(points.filter((p) => p.seriesId !== "now").map((p) => `${p.marker} ${p.seriesName}: <b>${rounded(p.value[1] ?? NaN)}</b> Hz`))
        .join("<br>"),
    ),
    series: [...lines(data, t), marks(t)],
  });
  const it = chart(element, full, (data, t) => (data.said ? null : { series: [...lines(data, t).map((s) => ({ id: s.id, data: s.data })), marks(t)] }));
  return {
    ...it,
    text: () => (it.data?.lines ? wide([it.data.unit ? `${it.data.label} [${it.data.unit}]` : it.data.label, ...it.data.lines.map((_, k) => `mode ${k + 1} [Hz]`)], it.data.lines) : ""),
    show(data) {
      if (data.said) return it.show({ said: data.said, signature: data.said });
      if (data.cursor) cursor = data.cursor;
      if (data.curve) it.show({ ...data.curve, signature: JSON.stringify([data.curve.label, data.curve.unit, data.curve.low, data.curve.high, data.curve.lines.length]) });
      else if (it.data?.lines) it.instance.setOption({ series: [marks(theme())] });
    },
  };
}

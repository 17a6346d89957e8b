// A beam with its ends and what it carries; marks are dragged along it, or moved by the arrow keys.
import { registry } from "antinode-app";
import { tabbed } from "./charts.js";
import { rounded, svg } from "./theme.js";

const HEIGHT = 20; // pixels of half the thickest part

export function beam(element) {
  const root = svg("svg", { class: "an-svg" });
  element.append(root);
  let last = null;
  let dragged = null;
  let place = null; // x of a pixel [m]

  function draw() {
    if (!last) return;
    const [width, height] = [element.clientWidth, element.clientHeight];
    if (width < 50 || height < 50) return;
    const d = last;
    const [x0, x1] = [d.x[0], d.x[d.x.length - 1]];
    const [left, right] = [70, 70];
    const scale = (width - left - right) / (x1 - x0);
    const X = (x) => left + scale * (x - x0);
    place = (pixel) => Math.min(x1, Math.max(x0, x0 + (pixel - left) / scale));
    const y0 = height / 2 - 8;
    const half = Math.min(HEIGHT, height / 7);
    const parts = [defs()];
    if (d.foundation) {
      parts.push(svg("rect", { class: "an-soil", x: X(x0), y: y0 + half, width: X(x1) - X(x0), height: 10 }));
      parts.push(svg("text", { class: "an-rulertext", x: X(x1), y: y0 + half + 22, "text-anchor": "end" }, "elastic foundation"));
    }
    const edge = (sign) => d.x.map((x, k) => `${X(x).toFixed(1)},${(y0 + sign * half * d.half[k]).toFixed(1)}`);
    parts.push(svg("polygon", { class: "an-body", points: [...edge(-1), ...edge(1).reverse()].join(" ") }));
    parts.push(svg("text", { class: "an-rulertext", x: X(x0), y: 11 }, d.drawn ? "height as drawn, not to scale with the length" : "height by log EI, not to scale"));
    parts.push(...end(d.ends[0], X(x0), y0, -1, half), ...end(d.ends[1], X(x1), y0, 1, half));
    parts.push(...push(d, 0, X(x0), y0, -1), ...push(d, 1, X(x1), y0, 1));
    parts.push(...ruler(d, X, x0, x1, height));
    const focus = root.contains(document.activeElement) ? document.activeElement.dataset.path : null;
    const rows = [];
    for (const item of d.items) parts.push(mark(item, X, x0, x1, y0, half, rows));
    root.setAttribute("viewBox", `0 0 ${width} ${height}`);
    root.replaceChildren(...parts);
    if (focus) root.querySelector(`[data-path="${focus}"]`)?.focus();
  }

  function defs() {
    const node = svg("defs");
    const tip = svg("marker", { id: "an-tip", viewBox: "0 0 8 8", refX: 7, refY: 4, markerWidth: 6, markerHeight: 6, orient: "auto-start-reverse" });
    tip.append(svg("path", { d: "M0,0.6 L8,4 L0,7.4 z", class: "an-tip" }));
    const hatch = svg("pattern", { id: "an-hatch", width: 6, height: 6, patternUnits: "userSpaceOnUse", patternTransform: "rotate(45)" });
    hatch.append(svg("line", { class: "an-ruler", x1: 0, y1: 0, x2: 0, y2: 6 }));
    node.append(tip, hatch);
    return node;
  }

  function end(kind, x, y, out, half) {
    const reach = half + 12;
    if (kind === "clamped")
      return [
        svg("rect", { fill: "url(#an-hatch)", x: out < 0 ? x - 9 : x, y: y - reach, width: 9, height: 2 * reach }),
        svg("line", { class: "an-wallline", x1: x, x2: x, y1: y - reach, y2: y + reach }),
      ];
    if (kind === "pinned") return [support(x, y)];
    if (kind === "sliding")
      return [
        svg("line", { class: "an-wallline", x1: x, x2: x, y1: y - reach, y2: y + reach }),
        svg("circle", { class: "an-hollow", cx: x + 5 * out, cy: y - 8, r: 4 }),
        svg("circle", { class: "an-hollow", cx: x + 5 * out, cy: y + 8, r: 4 }),
      ];
    return [];
  }

  const support = (x, y) => svg("path", { class: "an-support", d: `M${x},${y} l-9,16 h18 z` });

  // The force outside an end; one that turns with the end is drawn on a bent tip.
  function push(d, k, x, y, out) {
    if (!d.force[k]) return [];
    const inwards = d.push[k] > 0;
    const [near, far] = [x + out * 12, x + out * 50];
    const lift = d.follow[k] ? -9 : 0;
    const ends = inwards ? [far, y + lift, near, y] : [near, y, far, y + lift];
    const line = svg("line", { class: "an-arrow", x1: ends[0], y1: ends[1], x2: ends[2], y2: ends[3], "marker-end": "url(#an-tip)" });
    const words = svg("text", { class: "an-force", x: x + out * 64, y: y - 14, "text-anchor": out < 0 ? "start" : "end" }, d.force[k]);
    const how = svg("text", { class: "an-rulertext", x: x + out * 64, y: y + 20, "text-anchor": out < 0 ? "start" : "end" }, d.follow[k] ? "follows" : "fixed");
    return [line, words, how];
  }

  const SHAPES = {
    mass: (x, y) => [svg("circle", { class: "an-massmark", cx: x, cy: y, r: 8 })],
    support: (x, y, half) => [support(x, y + half)],
    spring: (x, y, half) => [svg("path", { class: "an-coil", d: `M${x},${y + half} v4 l6,3 l-12,6 l12,6 l-12,6 l6,3 v4 M${x - 8},${y + half + 32} h16` })],
    pedestal: (x, y, half) => [
      svg("path", { class: "an-coil", d: `M${x},${y + half} v2 l4,2 l-8,3 l8,3 l-4,2 v2 M${x},${y + half + 24} v2 l4,2 l-8,3 l8,3 l-4,2 v2 M${x - 8},${y + half + 38} h16` }),
      svg("rect", { class: "an-massmark", x: x - 6, y: y + half + 14, width: 12, height: 10 }),
    ],
    joint: (x, y) => [svg("path", { class: "an-jointmark", d: `M${x},${y - 9} l9,9 l-9,9 l-9,-9 z` })],
    dashpot: (x, y, half) => [svg("path", { class: "an-coil", d: `M${x},${y + half} v12 M${x - 6},${y + half + 12} h12 M${x - 9},${y + half + 8} v14 h18 v-14 M${x},${y + half + 22} v8 M${x - 8},${y + half + 30} h16` })],
    feedback: (x, y, half) => [svg("path", { class: "an-coil", d: `M${x - 8},${y - half - 6} a8,8 0 1 1 14,5 M${x + 6},${y - half} l-2,-6 l7,2` })],
    force: (x, y, half, item) => {
      const [a, b] = [x - 16 * item.sign, x + 16 * item.sign];
      return [svg("line", { class: "an-arrow", x1: a, y1: y, x2: b, y2: y, "marker-end": "url(#an-tip)" })];
    },
  };

  function halfAt(d, x) {
    const k = Math.max(0, d.x.findIndex((v) => v >= x));
    return d.half[k];
  }

  function mark(item, X, x0, x1, y0, half, rows) {
    const x = X(item.x);
    const own = half * halfAt(last, item.x);
    const node = svg("g", {
      ...{ class: "an-mover", tabindex: 0, role: "slider", "data-path": item.path, "aria-label": `${item.name}, place along the beam` },
      ...{ "aria-valuenow": rounded(item.x), "aria-valuemin": rounded(x0), "aria-valuemax": rounded(x1) },
    });
    node.append(svg("rect", { class: "an-grip", x: x - 12, y: y0 - half - 12, width: 24, height: 2 * half + 48 }));
    node.append(...(SHAPES[item.kind] ?? SHAPES.mass)(x, y0, own, item));
    const below = ["spring", "support", "dashpot", "pedestal"].includes(item.kind);
    const size = item.name.length * 5.6;
    const from = Math.max(2, Math.min(x - size / 2, element.clientWidth - size - 2));
    if (below) {
      let row = y0 + own + 24;
      while (rows.some((o) => Math.abs(o.y - row) < 11 && x + 14 < o.to + 4 && x + 14 + size > o.from - 26)) row += 13;
      rows.push({ from: x + 14, to: x + 14 + size, y: row });
      node.append(svg("text", { class: "an-force", x: x + 14, y: row }, item.name));
      return grip(node, item, x0, x1);
    }
    let row = y0 - Math.max(own, 9) - 6;
    for (let k = 0; k < 3; k++) {
      if (rows.every((o) => Math.abs(o.y - row) > 11 || from > o.to + 4 || from + size < o.from - 4)) break;
      row -= 12;
    }
    rows.push({ from, to: from + size, y: row });
    node.append(svg("text", { class: "an-force", x: from, y: row }, item.name));
    return grip(node, item, x0, x1);
  }

  function grip(node, item, x0, x1) {
    node.addEventListener("pointerdown", (e) => {
      dragged = item.path;
      root.setPointerCapture(e.pointerId);
    });
    node.addEventListener("keydown", (e) => {
      const way = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 }[e.key];
      if (!way) return;
      e.preventDefault();
      const to = Math.min(x1, Math.max(x0, item.x + (way * (x1 - x0)) / 100));
      registry.emit("moved", { path: item.path, x: to });
    });
    node.addEventListener("keyup", () => registry.emit("released"));
    return node;
  }

  root.addEventListener("pointermove", (e) => {
    if (!dragged || !place) return;
    const x = place(e.clientX - root.getBoundingClientRect().left);
    last.items.find((item) => item.path === dragged).x = x;
    draw();
    registry.emit("moved", { path: dragged, x });
  });
  for (const over of ["pointerup", "pointercancel"])
    root.addEventListener(over, () => {
      if (dragged) registry.emit("released");
      dragged = null;
    });

  function ruler(d, X, x0, x1, height) {
    const parts = [];
    const y = height - 16;
    const unit = d.ticks.factor;
    const total = (x1 - x0) / unit;
    const step = [1, 2, 5, 10].map((s) => s * 10 ** Math.floor(Math.log10(total / 3))).find((s) => total / s <= 8) ?? total;
    parts.push(svg("line", { class: "an-ruler", x1: X(x0), x2: X(x1), y1: y, y2: y }));
    for (let v = Math.ceil(x0 / unit / step - 1e-9) * step; v * unit <= x1 * (1 + 1e-9) + 1e-12; v += step) {
      parts.push(svg("line", { class: "an-ruler", x1: X(v * unit), x2: X(v * unit), y1: y, y2: y + 3 }));
      const final = (v + step) * unit > x1 * (1 + 1e-9);
      parts.push(svg("text", { class: "an-rulertext", x: X(v * unit), y: y + 13, "text-anchor": "middle" }, rounded(Number(v.toPrecision(12))) + (final ? ` ${d.ticks.unit}` : "")));
    }
    return parts;
  }

  return {
    text: () => (last ? tabbed(["what", `x [${last.ticks.unit}]`], last.items.map((i) => [i.name, rounded(i.x / last.ticks.factor)])) : ""),
    show(data) {
      if (dragged && last) {
        const own = last.items.find((item) => item.path === dragged);
        const next = data.items.find((item) => item.path === dragged);
        if (own && next) next.x = own.x; // the pointer is ahead of the server
      }
      last = data;
      draw();
    },
    resize: draw,
  };
}

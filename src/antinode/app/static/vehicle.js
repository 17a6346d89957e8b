// The vehicle to scale in its cavity; forces as arrows whose length goes with the force.
import { tabbed } from "./charts.js";
import { rounded, svg } from "./theme.js";

const LONGEST = 78; // pixels of the largest arrow along the axis
const HIGHEST = 34; // ... and across it

export function vehicle(element) {
  const root = svg("svg", { class: "an-svg", "aria-hidden": "true" });
  element.append(root);
  let last = null;
  let longest = LONGEST;

  function draw() {
    if (!last) return;
    const width = element.clientWidth;
    const height = element.clientHeight;
    if (width < 50 || height < 50) return;
    const d = last;
    const narrow = width < 520; // labels then stand above the body, not beside it
    longest = narrow ? 0.1 * width : LONGEST;
    const left = narrow ? longest + 12 : longest + 58;
    const right = narrow ? longest + 12 : longest + 30;
    const tallest = Math.max(...d.cavity.top, ...d.cavity.bottom.map((v) => -v), ...d.fins.map((f) => Math.max(Math.abs(f[2]), Math.abs(f[3]))), ...d.body.map((p) => p[1]));
    const room = height / 2 - 16 - 14;
    const scale = Math.min((width - left - right) / d.length, room / tallest);
    const x0 = left + ((width - left - right) - scale * d.length) / 2;
    const y0 = height / 2 - 6;
    const X = (x) => x0 + scale * x;
    const Y = (y) => y0 - scale * y;
    const parts = [];
    parts.push(defs());
    const { x, top, bottom } = d.cavity;
    const edge = (ys) => x.map((v, k) => `${X(v).toFixed(1)},${Y(ys[k]).toFixed(1)}`);
    parts.push(svg("polygon", { class: "an-cavity", points: [...edge(top), ...edge(bottom).reverse()].join(" ") }));
    parts.push(svg("polyline", { class: "an-wall", points: edge(top).join(" ") }), svg("polyline", { class: "an-wall", points: edge(bottom).join(" ") }));
    for (const [a, b, low, high] of d.fins)
      parts.push(svg("rect", { class: "an-fin", x: X(a), y: Y(high), width: scale * (b - a), height: Math.max(1.5, scale * (high - low)) }));
    const upper = d.body.map(([v, r]) => `${X(v).toFixed(1)},${Y(r).toFixed(1)}`);
    const lower = d.body.map(([v, r]) => `${X(v).toFixed(1)},${Y(-r).toFixed(1)}`).reverse();
    parts.push(svg("polygon", { class: "an-body", points: [...upper, ...lower].join(" ") }));
    parts.push(svg("line", { class: "an-disk", x1: X(0), x2: X(0), y1: Y(d.disk), y2: Y(-d.disk) }));
    parts.push(svg("line", { class: "an-axis", x1: X(0), x2: X(d.length), y1: Y(0), y2: Y(0) }));
    parts.push(...arrows(d, X, Y, scale, height, width), ...ruler(d, X, height));
    root.setAttribute("viewBox", `0 0 ${width} ${height}`);
    root.replaceChildren(...parts);
  }

  function defs() {
    const node = svg("defs");
    const tip = svg("marker", { id: "an-tip", viewBox: "0 0 8 8", refX: 7, refY: 4, markerWidth: 6, markerHeight: 6, orient: "auto-start-reverse" });
    tip.append(svg("path", { d: "M0,0.6 L8,4 L0,7.4 z", class: "an-tip" }));
    node.append(tip);
    return node;
  }

  function arrows(d, X, Y, scale, height, width) {
    const parts = [];
    const taken = [];
    const place = (x, y, text, anchor) => {
      // move a label away from others: a row is 13 px
      const size = text.length * 5.7;
      const from = anchor === "end" ? x - size : anchor === "middle" ? x - size / 2 : x;
      const clear = (row) => taken.every((o) => Math.abs(o.y - row) > 12 || from > o.to + 4 || from + size < o.from - 4);
      const steps = y < height / 2 ? [0, 13, -13, 26] : [0, -13, 13, -26];
      const row = steps.map((s) => y + s).find((v) => v > 9 && v < height - 22 && clear(v)) ?? y;
      const inside = Math.max(2, Math.min(from, width - size - 2));
      taken.push({ from: inside, to: inside + size, y: row });
      parts.push(svg("text", { class: "an-force", x: inside, y: row }, text));
    };
    const beside = width < 520 ? Y(Math.max(...d.body.map((p) => p[1]))) - 12 : Y(0) - 8;
    const arrow = (x1, y1, x2, y2) => parts.push(svg("line", { class: "an-arrow", x1, y1, x2, y2, "marker-end": "url(#an-tip)" }));
    for (const a of d.arrows) {
      if (a.along) {
        const length = Math.max(9, Math.abs(a.size) * longest);
        const aft = a.size > 0;
        if (a.x <= 0.02 * d.length) {
          arrow(X(0) - 4 - length, Y(0), X(0) - 4, Y(0));
          place(X(0) - 8, beside, a.text, "end");
        } else if (a.x >= 0.98 * d.length) {
          const nozzle = X(d.length) + 4;
          if (aft) arrow(nozzle, Y(0), nozzle + length, Y(0));
          else arrow(nozzle + length, Y(0), nozzle, Y(0));
          place(width - 4, beside, a.text, "end");
        } else {
          const y = height - 34;
          arrow(X(a.x), y, X(a.x) + (aft ? length : -length), y);
          place(X(a.x) - 6, y + 4, a.text, "end");
        }
      } else {
        const length = Math.max(9, Math.abs(a.size) * HIGHEST);
        const up = a.size > 0;
        const start = Y(0);
        const end = up ? start - length - 6 : start + length + 6;
        arrow(X(a.x), start, X(a.x), end);
        place(X(a.x) + 5, up ? 12 : height - 34, a.text, "start");
        const y = up ? Math.min(end, 16) : height - 38;
        if ((up && end > 18) || (!up && end < height - 40)) parts.push(svg("line", { class: "an-lead", x1: X(a.x), x2: X(a.x), y1: end, y2: y }));
      }
    }
    return parts;
  }

  function ruler(d, X, height) {
    const parts = [];
    const y = height - 14;
    const total = d.length / d.ticks.factor;
    const step = [1, 2, 5].map((s) => s * 10 ** Math.floor(Math.log10(total / 3))).find((s) => total / s <= 8) ?? total;
    parts.push(svg("line", { class: "an-ruler", x1: X(0), x2: X(d.length), y1: y, y2: y }));
    for (let v = 0; v <= total * 1.0001; v += step) {
      const at = X(v * d.ticks.factor);
      parts.push(svg("line", { class: "an-ruler", x1: at, x2: at, y1: y, y2: y + 3 }));
      const last = v + step > total * 1.0001;
      parts.push(svg("text", { class: "an-rulertext", x: at, y: y + 13, "text-anchor": "middle" }, rounded(v) + (last ? ` ${d.ticks.unit}` : "")));
    }
    const cm = X(d.centre);
    parts.push(svg("path", { class: "an-centre", d: `M${cm - 4},${y - 5} h8 l-4,5 z` }));
    return parts;
  }

  return {
    text: () => (last ? tabbed(["force", "value", "x / length"], last.arrows.map((a) => [...a.text.match(/^(.*?) ([-\d.].*)$/).slice(1), rounded(a.x / last.length)])) : ""),
    show(data) {
      last = data;
      draw();
    },
    resize: draw,
  };
}

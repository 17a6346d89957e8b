// The table of frequencies: numbers, and bars on one common scale with baseline, band and lines.
import { registry } from "antinode-app";
import { html } from "./theme.js";

const HEADS = [
  ["mode", "Mode"],
  ["hz", "Hz"],
  ["error", "±"],
  ["bar", "on one scale"],
  ["change", "vs pinned"],
  ["damping", "damping"],
  ["shift", "by N"],
  ["shear", "by shear"],
];

export function frequencies(element) {
  const table = html("table", "an-table");
  const caption = html("caption", "an-sr", "Natural frequencies");
  const head = html("thead");
  const row = html("tr");
  for (const [name, text] of HEADS) {
    const cell = html("th", `an-${name}`, name === "bar" ? "" : text);
    if (name === "bar") cell.append(html("span", "an-sr", text)); // there is no room to show it
    cell.scope = "col";
    row.append(cell);
  }
  row.querySelector(".an-shift").title = "change by the axial force";
  row.querySelector(".an-damping").title = "ratio of the damping, or the rate of growth";
  row.querySelector(".an-error").title = "bound on the error [Hz] of this model";
  row.querySelector(".an-shear").title = "effect of shear and rotary inertia: solved, or estimated where the theory leaves them out";
  head.append(row);
  const rows = html("tbody");
  table.append(caption, head, rows);
  const foot = html("div", "an-foot");
  const left = html("div", "an-left");
  element.append(table, foot, left);
  let last = null;

  function bar(data, r) {
    const box = html("div", "an-barbox");
    const percent = (f) => `${(100 * f) / data.top}%`;
    if (data.band) {
      const band = html("div", "an-band");
      band.style.left = percent(data.band[0]);
      band.style.width = percent(data.band[1] - data.band[0]);
      box.append(band);
    }
    for (const f of data.lines) {
      const line = html("div", "an-line");
      line.style.left = percent(f);
      box.append(line);
    }
    if (r.hz !== null) {
      const fill = html("div", r.flag ? "an-fill an-flagged" : "an-fill");
      fill.style.width = percent(r.hz);
      box.append(fill);
    }
    if (r.baseline) {
      const tick = html("div", "an-tick");
      tick.style.left = percent(r.baseline);
      box.append(tick);
    }
    return box;
  }

  function line(data, r) {
    const tr = html("tr", r.flag ? "an-flagrow" : "");
    tr.classList.toggle("an-chosen", Number(r.number) === data.chosen);
    tr.title = [`${r.name}: show its shape, forces, energies`, r.flag].filter(Boolean).join("; ");
    tr.addEventListener("click", () => registry.emit("chosen", Number(r.number)));
    const name = html("th", "an-mode");
    const choose = html("button", "an-choose", r.number);
    choose.setAttribute("aria-label", `Show ${r.name}`);
    name.append(choose);
    name.scope = "row";
    if (r.flag) {
      const mark = html("span", "an-mark", "▲");
      mark.setAttribute("aria-label", r.flag);
      name.append(mark);
    }
    const cells = [html("td", r.hz === null ? "an-hz an-kind" : "an-hz", r.text), html("td", "an-error", r.error), html("td", "an-bar")];
    cells[2].append(bar(data, r));
    tr.append(name, ...cells, html("td", "an-change", r.change), html("td", "an-damping", r.damping), html("td", "an-shift", r.shift));
    tr.append(html("td", "an-shear", r.shear));
    return tr;
  }

  let count = 0;
  let family = "";
  const fit = () => {
    const room = (element.clientHeight - 30 - foot.offsetHeight - left.offsetHeight) / Math.max(count, 1) - 1;
    table.style.setProperty("--an-row", `${Math.max(20, Math.min(38, Math.floor(room)))}px`);
  };

  return {
    resize: fit,
    text() {
      if (!last) return "";
      const heads = ["mode", "frequency [Hz]", "error [Hz]", "vs pinned", "damping", "by N", "by shear"];
      const rows = last.rows.map((r) => [r.name, r.text, r.error, r.change, r.damping, r.shift, r.shear]);
      return [heads, ...rows, [`not in the model: ${last.left_out.join("; ")}`]].map((c) => c.join("\t")).join("\n");
    },
    show(data) {
      if (data.quick && !data.rows.length && data.family === family) {
        table.classList.add("an-quick"); // the last rows stay until the full result is there
        return;
      }
      family = data.family;
      last = data;
      left.textContent = `Not in the model: ${data.left_out.join("; ")}.`;
      table.classList.toggle("an-pinned", data.pinned);
      table.classList.toggle("an-quick", data.quick);
      table.classList.toggle("an-damped", data.damped);
      rows.replaceChildren(...data.rows.map((r) => line(data, r)));
      count = data.rows.length;
      const flagged = data.rows.filter((r) => r.flag);
      const texts = flagged.map((r) => `mode ${r.number} ${r.flag}`);
      foot.textContent = data.rows.length ? texts.join(" · ") : "computing …";
      foot.hidden = data.rows.length > 0 && !flagged.length;
      fit();
      caption.textContent = `Natural frequencies, ${data.family} modes`;
    },
  };
}

// The lowest frequencies in one line, for screens on which the table may be out of sight.
export function strip(element) {
  return {
    show(data) {
      if (!data.rows.length) return;
      const parts = data.rows.slice(0, 6).map((r) => {
        const part = html("span", r.flag ? "an-stripped an-flagrow" : "an-stripped");
        part.append(html("b", "", `${r.number} `), html("span", "", r.hz === null ? r.text : `${r.text} Hz `));
        return part;
      });
      element.replaceChildren(...parts);
    },
  };
}

// A table from the server: headings, cells, bars behind them where there is a share, what is said below.
import { html } from "./theme.js";

export function sheet(element) {
  let last = null;
  const cellText = (c) => (typeof c === "string" ? c : c.text);

  function cell(content, k) {
    const node = html(k ? "td" : "th", "", "");
    if (!k) node.scope = "row";
    if (typeof content !== "string" && content.share) {
      const bar = html("span", "an-effect");
      const half = 50 * Math.min(1, Math.abs(content.share));
      bar.style.width = `${half}%`;
      bar.style[content.share < 0 ? "right" : "left"] = "50%";
      node.append(bar);
    }
    node.append(html("span", "an-celltext", cellText(content)));
    return node;
  }

  return {
    text() {
      if (!last) return "";
      return [last.columns, ...last.rows.map((row) => row.map(cellText)), ...last.notes.map((n) => [n])].map((row) => row.join("\t")).join("\n");
    },
    show(data) {
      last = data;
      const parts = [];
      if (data.columns.length) {
        const table = html("table", "an-sheet");
        const head = html("tr");
        for (const text of data.columns) {
          const cell = html(text ? "th" : "td", "", text);
          if (text) cell.scope = "col";
          head.append(cell);
        }
        const top = html("thead");
        const rows = html("tbody");
        top.append(head);
        for (const row of data.rows) {
          const line = html("tr");
          line.append(...row.map(cell));
          rows.append(line);
        }
        table.append(top, rows);
        parts.push(table);
      }
      if (data.meaning) parts.push(html("p", "an-hint", data.meaning));
      for (const note of data.notes) parts.push(html("p", "an-hint", note));
      element.replaceChildren(...parts);
    },
  };
}

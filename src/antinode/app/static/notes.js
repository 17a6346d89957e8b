// Facts, warnings and ranges of validity.
import { html } from "./theme.js";

export function notes(element) {
  return {
    show(data) {
      const facts = html("dl", "an-facts");
      for (const [name, text] of data.facts) facts.append(html("dt", "", name), html("dd", "", text));
      const parts = [facts];
      const outside = data.ranges.filter((r) => !r.inside).length;
      const title = data.warnings.length === 1 ? "1 warning" : `${data.warnings.length || "No"} warnings`;
      parts.push(html("h3", data.warnings.length ? "an-warned" : "", title));
      for (const text of data.warnings) parts.push(html("p", "an-warning", text));
      if (data.ranges.length) {
        parts.push(html("h3", outside ? "an-warned" : "", outside ? `${outside} of ${data.ranges.length} correlations out of range` : `All ${data.ranges.length} correlations in range`));
        const list = html("ul", "an-ranges");
        for (const r of data.ranges) {
          const item = html("li", r.inside ? "" : "an-out");
          item.append(html("span", "an-sign", r.inside ? "✓" : "▲"), html("b", "", r.name), html("span", "", ` ${r.text}; ${r.allowed}`));
          list.append(item);
        }
        parts.push(list);
      }
      element.replaceChildren(...parts);
    },
  };
}

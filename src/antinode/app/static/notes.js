// Facts, warnings and ranges of validity.
import { html } from "./theme.js";

export function notes(element) {
  let last = null; // warnings of the last full result: while something moves they are being checked
  return {
    show(data) {
      if (!data.quick) last = data.warnings;
      const warnings = data.quick && last ? [...new Set([...data.warnings, ...last])] : data.warnings;
      const facts = html("dl", "an-facts");
      for (const [name, text] of data.facts) facts.append(html("dt", "", name), html("dd", "", text));
      const parts = [facts];
      const outside = data.ranges.filter((r) => !r.inside).length;
      const count = warnings.length === 1 ? "1 warning" : `${warnings.length || "No"} warnings`;
      const title = data.quick ? "Warnings are being checked" : count;
      parts.push(html("h3", warnings.length ? "an-warned" : "", title));
      for (const text of warnings) parts.push(html("p", data.quick ? "an-warning an-old" : "an-warning", text));
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
      parts.push(html("h3", "", "Not in the model"));
      const left = html("ul", "an-ranges an-leftout");
      for (const text of data.left_out) left.append(html("li", "", text));
      parts.push(left);
      element.replaceChildren(...parts);
    },
  };
}

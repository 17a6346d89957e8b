// Colours and type of the page, from its style sheet, for what is drawn on a canvas.
// They are read once for light and for dark: to ask for them makes the browser work out styles.
export function theme() {
  const now = document.body.classList.contains("body--dark");
  if (now !== of) [read, of] = [readTheme(), now];
  return read;
}

let read = null;
let of = null;

function readTheme() {
  const style = getComputedStyle(document.body);
  const value = (name) => style.getPropertyValue(name).trim();
  return {
    text: value("--an-text"),
    muted: value("--an-muted"),
    line: value("--an-line"),
    card: value("--an-card"),
    accent: value("--an-accent"),
    warn: value("--an-warn"),
    band: value("--an-band"),
    series: [1, 2, 3, 4, 5, 6].map((k) => value(`--an-s${k}`)),
  };
}
export const FONT = "Roboto, sans-serif";
export const seriesColour = (t, number) => t.series[(number - 1) % t.series.length];

export function svg(tag, attributes = {}, text) {
  const node = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
  if (text !== undefined) node.textContent = text;
  return node;
}

export function html(tag, className, text) {
  const node = document.createElement(tag);
  if (className) node.className = className;
  if (text !== undefined) node.textContent = text;
  return node;
}

export function rounded(value) {
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-3) return value.toExponential(2).replace("e+", "e");
  return String(Number(value.toPrecision(4)));
}

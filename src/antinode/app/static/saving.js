// A picture of the page as a file, or its numbers as text: charts, drawings, the body.
import { echarts } from "nicegui-echart";
import { theme } from "./theme.js";

const STYLES = ["fill", "stroke", "stroke-width", "stroke-dasharray", "opacity", "font-size", "font-family", "font-weight", "text-anchor"];

// A chart drawn anew as SVG, by the same options.
function chartSvg(instance) {
  const [width, height] = [instance.getWidth(), instance.getHeight()];
  const drawn = echarts.init(null, null, { renderer: "svg", ssr: true, width, height });
  drawn.setOption({ ...instance.getOption(), animation: false, backgroundColor: theme().card });
  const text = drawn.renderToSVGString();
  drawn.dispose();
  return text;
}

// A drawing with the style that the page gives it.
function drawingSvg(root) {
  const copy = root.cloneNode(true);
  const from = [root, ...root.querySelectorAll("*")];
  const to = [copy, ...copy.querySelectorAll("*")];
  from.forEach((node, k) => {
    const style = getComputedStyle(node);
    to[k].setAttribute("style", STYLES.map((name) => `${name}:${style.getPropertyValue(name)}`).join(";"));
    to[k].removeAttribute("class");
  });
  copy.setAttribute("xmlns", "http://www.w3.org/2000/svg");
  copy.setAttribute("width", root.clientWidth);
  copy.setAttribute("height", root.clientHeight);
  copy.style.background = theme().card;
  return new XMLSerializer().serializeToString(copy);
}

function painted(svgText, width, height) {
  return new Promise((done) => {
    const image = new Image();
    image.onload = () => {
      const canvas = document.createElement("canvas");
      [canvas.width, canvas.height] = [2 * width, 2 * height];
      canvas.getContext("2d").drawImage(image, 0, 0, 2 * width, 2 * height);
      done(canvas.toDataURL("image/png"));
    };
    image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svgText)}`;
  });
}

export function svgOf(view, element) {
  if (view.instance) return chartSvg(view.instance);
  const root = element.querySelector("svg");
  return root ? drawingSvg(root) : "";
}

export async function pngOf(view, element) {
  if (view.instance) return view.instance.getDataURL({ pixelRatio: 2, backgroundColor: theme().card });
  if (view.png) return view.png();
  const text = svgOf(view, element);
  return text ? painted(text, element.clientWidth, element.clientHeight) : "";
}

// Numbers with tabs, as spreadsheets take them.
export const textOf = (view) => view.text?.() ?? "";

// Text to the clipboard; where the page came over plain http from afar, by a selection.
export async function copied(text) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    const field = document.createElement("textarea");
    field.value = text;
    document.body.append(field);
    field.select();
    const done = document.execCommand("copy");
    field.remove();
    return done;
  }
}

export function save(name, address) {
  const link = document.createElement("a");
  [link.href, link.download] = [address, name];
  link.click();
}

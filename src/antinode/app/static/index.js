// The pictures of the page: each kind makes one picture inside an element from small JSON.
import { beam } from "./beam.js";
import { body } from "./body.js";
import { characteristic, curve, forces, modes } from "./charts.js";
import { frequencies, strip } from "./frequencies.js";
import { notes } from "./notes.js";
import { response } from "./response.js";
import { copied, pngOf, save, svgOf, textOf } from "./saving.js";
import { sheet } from "./sheet.js";
import { vehicle } from "./vehicle.js";

export const kinds = {
  ...{ beam, body, characteristic, curve, forces, frequencies, modes, notes, response, strip, vehicle },
  ...{ mode: forces, effects: sheet, ends: sheet, stability: sheet, compare: sheet },
};

const HELD_BACK = 100; // milliseconds, more than those for which events of sliders wait for the next

// All pictures of the page by name; what arrives before a picture exists waits for it.
export const registry = {
  views: {},
  waiting: {},
  data: {}, // the last of each
  sequence: 0,
  shown: 0,
  asked: 0,
  answered: 0,
  add(name, view) {
    this.views[name] = view;
    if (name in this.waiting) view.show(this.waiting[name]);
    delete this.waiting[name];
  },
  remove(name) {
    this.views[name]?.destroy?.();
    delete this.views[name];
  },
  show(name, data) {
    if (name === "frequencies") this.show("strip", data);
    this.data[name] = data;
    if (this.views[name]) this.views[name].show(data);
    else this.waiting[name] = data;
  },
  emit() {}, // to the server; the board says how
  // Returns a number that `answered` reaches once the server has answered all that was sent before.
  ask() {
    const number = ++this.asked;
    setTimeout(() => this.emit("asked", number), HELD_BACK);
    return number;
  },
  drawn(answered) {
    this.shown = this.sequence;
    this.answered = answered ?? this.answered;
  },
  // A panel fills the page, and again takes its place; Escape gives it back too.
  enlarge(button) {
    const panel = button.closest(".an-card");
    const on = !panel.classList.contains("an-large");
    this.shrink();
    panel.classList.toggle("an-large", on);
    for (const one of on ? panel.querySelectorAll(".an-picture") : []) this.views[one.dataset.name]?.enlarged?.(true);
    const shown = on && this.near(button);
    if (!shown) return;
    const drawn = Boolean(this.views[shown.dataset.name]?.instance || shown.querySelector("svg"));
    panel.classList.toggle("an-asvg", drawn);
    panel.classList.toggle("an-apng", drawn || Boolean(this.views[shown.dataset.name]?.png));
  },
  shrink() {
    for (const panel of document.querySelectorAll(".an-large")) {
      panel.classList.remove("an-large");
      for (const one of panel.querySelectorAll(".an-picture")) this.views[one.dataset.name]?.enlarged?.(false);
    }
  },
  // Tables go to the clipboard with tabs, as spreadsheets take them.
  async copy(name) {
    const text = this.views[name] ? textOf(this.views[name]) : "";
    this.emit("told", text && (await copied(text)) ? "Copied: paste it into a spreadsheet." : "There is nothing to copy yet.");
  },
  async copyLink() {
    this.emit("told", (await copied(location.href)) ? "The link is copied; it brings this view back." : "The browser refuses: copy its address by hand.");
  },
  near(button) {
    return [...button.closest(".an-card").querySelectorAll(".an-picture")].find((e) => e.offsetParent || e.clientWidth);
  },
  copyNear(button) {
    const near = this.near(button);
    if (near) this.copy(near.dataset.name);
  },
  // The picture beside a button as a file.
  async saveNear(button, kind) {
    const near = this.near(button);
    const name = near?.dataset.name;
    if (!name) return;
    const view = this.views[name];
    if (kind === "svg") save(`${name}.svg`, `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svgOf(view, near))}`);
    else save(`${name}.png`, await pngOf(view, near));
  },
  retheme() {
    for (const view of Object.values(this.views)) view.retheme?.();
  },
};
window.antinode = registry;

// The pictures of the page: each kind makes one picture inside an element from small JSON.
import { beam } from "./beam.js";
import { body } from "./body.js";
import { characteristic, curve, forces, modes } from "./charts.js";
import { frequencies, strip } from "./frequencies.js";
import { notes } from "./notes.js";
import { response } from "./response.js";
import { sheet } from "./sheet.js";
import { vehicle } from "./vehicle.js";

export const kinds = {
  ...{ beam, body, characteristic, curve, forces, frequencies, modes, notes, response, strip, vehicle },
  ...{ effects: sheet, ends: sheet, stability: sheet, compare: sheet },
};

// All pictures of the page by name; what arrives before a picture exists waits for it.
export const registry = {
  views: {},
  waiting: {},
  sequence: 0,
  shown: 0,
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
    if (this.views[name]) this.views[name].show(data);
    else this.waiting[name] = data;
  },
  emit() {}, // to the server; the board says how
  // A panel fills the page, and again takes its place; Escape gives it back too.
  enlarge(button) {
    const panel = button.closest(".an-card");
    const on = !panel.classList.contains("an-large");
    this.shrink();
    panel.classList.toggle("an-large", on);
  },
  shrink() {
    for (const panel of document.querySelectorAll(".an-large")) panel.classList.remove("an-large");
  },
  // Tables go to the clipboard with tabs, as spreadsheets take them.
  copy(name) {
    navigator.clipboard?.writeText(this.views[name]?.text?.() ?? "");
  },
  copyNear(button) {
    const near = [...button.closest(".an-card").querySelectorAll(".an-picture")].find((e) => e.offsetParent);
    if (near) this.copy(near.dataset.name);
  },
  retheme() {
    for (const view of Object.values(this.views)) view.retheme?.();
  },
};
window.antinode = registry;

// The pictures of the page: each kind makes one picture inside an element from small JSON.
import { body } from "./body.js";
import { characteristic, curve, forces, modes } from "./charts.js";
import { frequencies, strip } from "./frequencies.js";
import { notes } from "./notes.js";
import { vehicle } from "./vehicle.js";

export const kinds = { body, characteristic, curve, forces, frequencies, modes, notes, strip, vehicle };

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
  retheme() {
    for (const view of Object.values(this.views)) view.retheme?.();
  },
};
window.antinode = registry;

import { registry } from "antinode-app";

// Takes what the server has computed and hands each part to its picture, all in one go.
export default {
  template: `<div hidden><input ref="files" type="file" multiple accept=".toml,.csv" tabindex="-1" aria-hidden="true" @change="chosen" /></div>`,
  props: { address: String },
  mounted() {
    document.documentElement.lang = "en";
    registry.emit = (name, data) => this.$emit(name, data);
    const system = window.matchMedia("(prefers-color-scheme: dark)");
    document.fonts.ready.then(() => this.$emit("ready", system.matches));
    let dark = null; // menus and dialogs change the body's class too
    this.themes = new MutationObserver(() => {
      const now = document.body.classList.contains("body--dark");
      if (now !== dark) requestAnimationFrame(() => registry.retheme());
      dark = now;
    });
    this.themes.observe(document.body, { attributes: true, attributeFilter: ["class"] });
    // Menus and dialogs hang at the end of the body: landmarks of their own for screen readers.
    this.portals = new MutationObserver((changes) => {
      for (const node of changes.flatMap((c) => [...c.addedNodes])) {
        if (!node.id?.startsWith("q-portal--menu")) continue;
        node.setAttribute("role", "region");
        node.setAttribute("aria-label", "Menu");
      }
    });
    this.portals.observe(document.body, { childList: true });
    this.over = 0;
    const bar = document.querySelector(".an-app");
    const files = (e) => [...(e.dataTransfer?.types ?? [])].includes("Files");
    this.listeners = {
      dragenter: (e) => files(e) && (e.preventDefault(), this.over++, bar?.classList.add("an-drop")),
      dragover: (e) => files(e) && e.preventDefault(),
      dragleave: (e) => files(e) && --this.over <= 0 && bar?.classList.remove("an-drop"),
      keydown: (e) => e.key === "Escape" && registry.shrink(),
      drop: (e) => {
        if (!files(e)) return;
        e.preventDefault();
        this.over = 0;
        bar?.classList.remove("an-drop");
        this.$emit("dropped");
        this.send(e.dataTransfer.files);
      },
    };
    for (const [name, listener] of Object.entries(this.listeners)) window.addEventListener(name, listener);
  },
  beforeUnmount() {
    this.themes?.disconnect();
    this.portals?.disconnect();
    for (const [name, listener] of Object.entries(this.listeners)) window.removeEventListener(name, listener);
  },
  methods: {
    apply(patch) {
      for (const [name, data] of Object.entries(patch.pictures ?? {})) registry.show(name, data);
      if ("stale" in patch) document.querySelector(".an-main")?.classList.toggle("an-stale", patch.stale);
      if ("address" in patch) window.history.replaceState(window.history.state, "", patch.address);
      registry.sequence = patch.sequence ?? registry.sequence;
      requestAnimationFrame(() => requestAnimationFrame(() => registry.drawn(patch.answered)));
    },
    play(on) {
      for (const view of Object.values(registry.views)) view.play?.(on);
    },
    reset() {
      registry.views.body?.reset?.();
    },
    async send(list) {
      const form = new FormData();
      for (const file of list) form.append("files", file, file.name);
      try {
        const answer = await fetch(this.address, { method: "POST", body: form });
        if (!answer.ok) this.$emit("refused", (await answer.text()).replace(/^antinode: /, ""));
      } catch {
        this.$emit("refused", "the files did not reach the server: they are too large, or it has stopped");
      }
    },
    chosen() {
      this.send(this.$refs.files.files);
      this.$refs.files.value = "";
    },
    choose() {
      this.$refs.files.click();
    },
  },
};

import { kinds, registry } from "antinode-app";

export default {
  template: `<div class="an-picture" :role="role" :data-name="name" :aria-label="label" :tabindex="role === 'region' ? 0 : null"></div>`,
  props: { kind: String, name: String, label: String, role: String },
  mounted() {
    this.view = kinds[this.kind](this.$el);
    registry.add(this.name, this.view);
    this.observer = new ResizeObserver(() => this.view.resize?.());
    this.observer.observe(this.$el);
  },
  beforeUnmount() {
    this.observer?.disconnect();
    registry.remove(this.name);
  },
};

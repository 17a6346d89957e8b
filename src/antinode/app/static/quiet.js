// A control of Quasar that keeps its own value: moved or told a value, it alone is drawn anew.
export default {
  inheritAttrs: false,
  template: `<component :is="control" ref="qRef" v-bind="$attrs" :model-value="here" @update:model-value="say" />`,
  props: { value: null, control: String },
  data() {
    return { here: this.value };
  },
  watch: {
    value(now) {
      this.here = now;
    },
  },
  methods: {
    say(now) {
      this.here = now;
      this.$emit("update:value", now);
    },
    take(now) {
      this.here = now;
    },
  },
};

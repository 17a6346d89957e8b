// The body in three dimensions, bending in one mode; turned with the mouse.
import { OrbitControls, THREE } from "nicegui-scene";
import { tabbed } from "./charts.js";
import { theme } from "./theme.js";

const AROUND = 28;
const TWIST = 0.7; // rad, at the largest
const SWING = 0.09; // of the length, at the largest displacement

export function body(element) {
  let renderer;
  try {
    renderer = new THREE.WebGLRenderer({ antialias: true, alpha: true });
  } catch {
    element.textContent = "This browser has no WebGL; the 3-D view is left out.";
    return { show() {} };
  }
  renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
  element.append(renderer.domElement);
  const scene = new THREE.Scene();
  const camera = new THREE.PerspectiveCamera(32, 2, 0.01, 20);
  camera.position.set(0.3, 0.32, 1.2);
  const controls = new OrbitControls(camera, renderer.domElement);
  controls.enablePan = false;
  controls.minDistance = 0.4;
  controls.maxDistance = 4;
  controls.addEventListener("change", () => paint());
  scene.add(new THREE.HemisphereLight(0xffffff, 0x667788, 2.2));
  const sun = new THREE.DirectionalLight(0xffffff, 1.6);
  sun.position.set(1, 2, 3);
  scene.add(sun);
  const skin = new THREE.MeshStandardMaterial({ roughness: 0.55, metalness: 0.15, vertexColors: true, side: THREE.DoubleSide });
  const steel = new THREE.MeshStandardMaterial({ roughness: 0.6, side: THREE.DoubleSide });
  const still = new THREE.LineBasicMaterial();
  let hull = null;
  let axis = null;
  let fins = [];
  let data = null;
  let playing = false;
  let start = performance.now();
  let timer = 0;

  function build() {
    for (const old of [hull, axis, ...fins]) {
      if (!old) continue;
      scene.remove(old);
      old.geometry.dispose();
    }
    const rings = data.x.length;
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(3 * rings * (AROUND + 1)), 3));
    geometry.setAttribute("color", new THREE.BufferAttribute(new Float32Array(3 * rings * (AROUND + 1)), 3));
    const index = [];
    for (let i = 0; i + 1 < rings; i++)
      for (let j = 0; j < AROUND; j++) {
        const a = i * (AROUND + 1) + j;
        const b = a + AROUND + 1;
        index.push(a, b, a + 1, b, b + 1, a + 1);
      }
    geometry.setIndex(index);
    hull = new THREE.Mesh(geometry, skin);
    axis = new THREE.Line(new THREE.BufferGeometry().setFromPoints([new THREE.Vector3(-0.56, 0, 0), new THREE.Vector3(0.56, 0, 0)]), still);
    fins = data.fins.map((fin) => {
      const plate = new THREE.BufferGeometry();
      const [a, b, r] = [fin.x - fin.chord / 2 - 0.5, fin.x + fin.chord / 2 - 0.5, fin.tip];
      const [up, side] = [Math.cos(fin.roll), Math.sin(fin.roll)];
      const corners = [a, 0, 0, b, 0, 0, b, r * up, r * side, a, r * up, r * side];
      plate.setAttribute("position", new THREE.BufferAttribute(new Float32Array(corners), 3));
      plate.setIndex([0, 1, 2, 0, 2, 3]);
      plate.computeVertexNormals();
      return new THREE.Mesh(plate, steel);
    });
    scene.add(hull, axis, ...fins);
  }

  function bend() {
    if (!data || !hull) return;
    const time = (performance.now() - start) / 1000;
    const phase = playing ? Math.cos(2 * Math.PI * 0.6 * time) : 1;
    const t = theme();
    const [quiet, strong] = [new THREE.Color(t.band), new THREE.Color(t.accent)];
    const colour = new THREE.Color();
    const { position, color } = hull.geometry.attributes;
    const n = data.x.length;
    const moved = data.shape.map((y) => SWING * phase * y);
    const none = data.shape.map(() => 0);
    const lift = data.way === "across" ? moved : none;
    const push = data.way === "along" ? moved : none;
    const twist = data.way === "about" ? data.shape.map((y) => TWIST * phase * y) : none;
    let k = 0;
    for (let i = 0; i < n; i++) {
      const [p, q] = [Math.max(i - 1, 0), Math.min(i + 1, n - 1)];
      const slope = (lift[q] - lift[p]) / (data.x[q] - data.x[p]);
      const norm = Math.hypot(1, slope);
      colour.lerpColors(quiet, strong, Math.min(1, Math.abs(data.shape[i])));
      for (let j = 0; j <= AROUND; j++, k++) {
        const angle = (2 * Math.PI * j) / AROUND + twist[i];
        const up = data.radius[i] * Math.cos(angle);
        position.setXYZ(k, data.x[i] + push[i] - 0.5 - (up * slope) / norm, lift[i] + up / norm, data.radius[i] * Math.sin(angle));
        color.setXYZ(k, colour.r, colour.g, colour.b);
      }
    }
    position.needsUpdate = color.needsUpdate = true;
    hull.geometry.computeVertexNormals();
    hull.geometry.computeBoundingSphere();
    data.fins.forEach((fin, f) => {
      const i = data.x.findIndex((x) => x >= fin.x);
      fins[f].position.set(push[Math.max(i, 0)] ?? 0, lift[Math.max(i, 0)] ?? 0, 0);
      fins[f].rotation.x = -(twist[Math.max(i, 0)] ?? 0);
    });
    paint();
  }

  let due = 0;
  function paint() {
    due ||= requestAnimationFrame(() => {
      due = 0;
      renderer.render(scene, camera);
    });
  }

  function resize() {
    const [w, h] = [element.clientWidth, element.clientHeight];
    if (w < 10 || h < 10) return;
    renderer.setSize(w, h, false);
    camera.aspect = w / h;
    const half = Math.tan((camera.fov / 2) * (Math.PI / 180));
    camera.position.setLength(Math.max(0.9, 0.6 / (half * camera.aspect)));
    camera.updateProjectionMatrix();
    paint();
  }

  function colours() {
    const t = theme();
    steel.color.set(t.muted);
    still.color.set(t.muted);
  }

  function step() {
    if (!playing) return;
    if (!document.hidden) bend();
    timer = setTimeout(() => requestAnimationFrame(step), 25);
  }

  colours();
  resize();
  return {
    show(next) {
      const rebuild = !data || data.x.length !== next.x.length || data.fins.length !== next.fins.length || JSON.stringify(data.fins) !== JSON.stringify(next.fins);
      data = next;
      if (rebuild) build();
      bend();
    },
    play(on) {
      playing = on;
      start = performance.now();
      clearTimeout(timer);
      if (on) step();
      else bend();
    },
    retheme() {
      colours();
      bend();
    },
    reset() {
      controls.reset();
      resize();
    },
    resize,
    text: () => (data ? tabbed(["x / length", "radius / length", "shape"], data.x.map((x, k) => [x, data.radius[k], data.shape[k]])) : ""),
    png() {
      renderer.render(scene, camera);
      return renderer.domElement.toDataURL("image/png");
    },
    destroy() {
      playing = false;
      controls.dispose();
      renderer.dispose();
    },
  };
}

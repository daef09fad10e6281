"use strict";
// Where the eye is, and what mouse, touch and keys do to it. Angles in radians; lengths in the unit of the machine.

const VIEWS = { home: [-1.22, 0.34], front: [-Math.PI / 2, 0], side: [0, 0], top: [-Math.PI / 2, 1.5533] };
const STEEPEST = 1.5533; // 89 degrees

class Camera {
  // The machine keeps within `radius` of a vertical line through `centre`, and within `half` above and below it.
  constructor(centre, radius, half) {
    this.start = { centre, radius, half, tall: 0.94 * half + 0.34 * radius };
    this.reset();
  }

  reset() {
    [this.azimuth, this.elevation] = VIEWS.home;
    this.zoom = 1;
    this.shift = [0, 0];
  }

  look(name) {
    this.reset();
    [this.azimuth, this.elevation] = VIEWS[name];
    if (name === "top") this.zoom = Math.min(1, this.start.tall / this.start.radius);
  }

  turn(dx, dy) {
    this.azimuth -= dx;
    this.elevation = Math.max(-STEEPEST, Math.min(STEEPEST, this.elevation + dy));
  }

  // The frame of the eye for a canvas of this size: right, up and toward the eye, and points on the canvas.
  frame(width, height) {
    const [ca, sa, ce, se] = [Math.cos(this.azimuth), Math.sin(this.azimuth), Math.cos(this.elevation), Math.sin(this.elevation)];
    const right = [-sa, ca, 0], up = [-ca * se, -sa * se, ce], toward = [ca * ce, sa * ce, se];
    const { centre, radius, half, tall } = this.start;
    const far = 6 * Math.hypot(radius, half), scale = 0.42 * this.zoom * Math.min(width / radius, height / tall);
    const eye = centre.map((x, k) => x + far * toward[k]);
    const project = (point) => {
      const v = point.map((x, k) => x - centre[k]);
      const depth = dot(v, toward);
      const near = (far / Math.max(far - depth, 0.05 * far)) * scale;
      return [width / 2 + this.shift[0] + dot(v, right) * near, height / 2 + this.shift[1] - dot(v, up) * near, depth];
    };
    return { eye, toward, right, up, project };
  }
}

// Call `changed` after each change of the camera.
function listen(canvas, camera, changed) {
  const fingers = new Map();
  const middle = () => [...fingers.values()].reduce(([x, y], p) => [x + p[0] / fingers.size, y + p[1] / fingers.size], [0, 0]);
  const spread = () => {
    const [a, b] = [...fingers.values()];
    return b ? Math.hypot(a[0] - b[0], a[1] - b[1]) : 0;
  };
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, [event.offsetX, event.offsetY]);
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!fingers.has(event.pointerId)) return;
    const [before, apart] = [middle(), spread()];
    fingers.set(event.pointerId, [event.offsetX, event.offsetY]);
    const after = middle(), dx = after[0] - before[0], dy = after[1] - before[1];
    if (fingers.size > 1 || event.shiftKey || event.buttons & 2) {
      camera.shift = [camera.shift[0] + dx, camera.shift[1] + dy];
      if (apart > 0 && spread() > 0) zoom(camera, spread() / apart);
    } else {
      camera.turn(0.008 * dx, 0.008 * dy);
    }
    changed();
  });
  for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, (event) => fingers.delete(event.pointerId));
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("dblclick", () => (camera.reset(), changed()));
  // The wheel scrolls the page until the picture was clicked.
  canvas.addEventListener("wheel", (event) => {
    if (document.activeElement !== canvas && !event.ctrlKey) return;
    event.preventDefault();
    zoom(camera, Math.exp(-0.0015 * event.deltaY));
    changed();
  }, { passive: false });
  canvas.addEventListener("keydown", (event) => {
    const step = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1] }[event.key];
    if (step) camera.turn(...step);
    else if (event.key === "+") zoom(camera, 1.25);
    else if (event.key === "-") zoom(camera, 0.8);
    else return;
    event.preventDefault();
    changed();
  });
}

function zoom(camera, factor) {
  camera.zoom = Math.max(0.2, Math.min(20, camera.zoom * factor));
}

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const between = (a, b, t) => [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => a.map((x) => x / (Math.hypot(...a) || 1));

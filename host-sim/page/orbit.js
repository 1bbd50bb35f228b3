// A camera that turns around what is seen: by mouse, touch and keys.

const TURN = Math.PI / 24;
const ZOOM = 1.1;
const clamp = (x, least, most) => Math.min(most, Math.max(least, x));

export class Orbit {
  constructor(canvas, moved) {
    this.canvas = canvas;
    this.moved = moved;
    this.pointers = new Map();
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
    });
    canvas.addEventListener("pointermove", (event) => this.drag(event));
    for (const end of ["pointerup", "pointercancel"]) {
      canvas.addEventListener(end, (event) => this.pointers.delete(event.pointerId));
    }
    canvas.addEventListener("keydown", (event) => this.key(event));
  }

  // Starts where a scene is first seen from.
  start({ from, at }) {
    const [x, y, z] = from.map((n, i) => n - at[i]);
    this.from = from;
    this.at = at;
    this.far = Math.hypot(x, y, z);
    this.distance = this.far;
    this.yaw = Math.atan2(x, z);
    this.pitch = Math.asin(y / this.far);
    this.untouched = true;
  }

  // Of single precision, as the module takes it; the first one to the bit.
  eye() {
    if (this.untouched) return this.from;
    const flat = Math.cos(this.pitch) * this.distance;
    const offset = [flat * Math.sin(this.yaw), this.distance * Math.sin(this.pitch), flat * Math.cos(this.yaw)];
    return offset.map((n, i) => Math.fround(n + this.at[i]));
  }

  turn(yaw, pitch, zoom = 1) {
    this.yaw += yaw;
    // Above the floor, and never straight from above, where no way is up.
    this.pitch = clamp(this.pitch + pitch, 0.04, 1.5);
    this.distance = clamp(this.distance * zoom, this.far / 2.5, this.far * 2.5);
    this.untouched = false;
    this.moved();
  }

  nearer() {
    this.turn(0, 0, 1 / ZOOM);
  }

  farther() {
    this.turn(0, 0, ZOOM);
  }

  reset() {
    this.start(this);
    this.moved();
  }

  drag(event) {
    const before = this.pointers.get(event.pointerId);
    if (!before) return;
    const now = [event.clientX, event.clientY];
    const [dx, dy] = now.map((n, i) => n - before[i]);
    if (this.pointers.size === 1) {
      const scale = Math.PI / this.canvas.clientWidth;
      if (dx || dy) this.turn(-dx * scale, dy * scale);
    } else if (this.pointers.size === 2) {
      const others = [...this.pointers].filter(([id]) => id !== event.pointerId);
      const apart = ([x, y]) => Math.hypot(x - others[0][1][0], y - others[0][1][1]);
      this.turn(0, 0, apart(before) / Math.max(1, apart(now)));
    }
    this.pointers.set(event.pointerId, now);
  }

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const act = {
      ArrowLeft: () => this.turn(-TURN, 0),
      ArrowRight: () => this.turn(TURN, 0),
      ArrowUp: () => this.turn(0, TURN),
      ArrowDown: () => this.turn(0, -TURN),
      "+": () => this.nearer(),
      "=": () => this.nearer(),
      "-": () => this.farther(),
      0: () => this.reset(),
    }[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  }
}

// The module's functions, and what they leave in its memory.

// Numbers of the report, in the module's order.
const FIELDS = [
  "shapes", "sceneBytes", "capacity", "used", "highWater", "needed", "structure", "mailbox",
  "reason", "nx", "ny", "nz", "divided", "maxLevel", "stoppedBy", "tests", "skips", "steps",
  "primary", "shadow", "secondary", "parts",
];

export const REASON = { asked: 0, few: 1, noMemory: 2, many: 3 };
export const STRUCTURE = ["none", "grid", "octree", "hierarchy"];
export const MAILBOX = ["off", "stamps", "cache"];
export const STOPPED = ["done", "level", "memory"];

export class Engine {
  constructor(exports) {
    this.exports = exports;
    // Never grows, so views of it stay what they are.
    this.buffer = exports.memory.buffer;
  }

  static async load(url) {
    const response = await fetch(url);
    if (!response.ok) throw new Error(`${url}: ${response.status} ${response.statusText}`);
    const { instance } = await WebAssembly.instantiate(await response.arrayBuffer(), {});
    return new Engine(instance.exports);
  }

  text(start, length) {
    return new TextDecoder().decode(new Uint8Array(this.buffer, start, length));
  }

  scenes() {
    return Array.from({ length: this.exports.scenes() }, (_, scene) => {
      const start = this.exports.name(scene);
      const length = new Uint8Array(this.buffer, start).indexOf(0);
      const [title, about = ""] = this.text(start, length).split(": ");
      const [x, y, z, ...rest] = new Float32Array(this.buffer, this.exports.view(scene), 6);
      return { title, about, from: [x, y, z], at: rest };
    });
  }

  // "built", "small" (the report says how much it takes) or "failed".
  select({ scene, structure, mailbox, ram }) {
    return ["built", "small", "failed"][this.exports.select(scene, structure, mailbox, ram)];
  }

  look([x, y, z], width, height) {
    return this.exports.look(x, y, z, width, height) === 0;
  }

  // Renders a row; gives views of its pixels and of their work, good until the next row.
  row(y, width) {
    const pixels = new Uint8ClampedArray(this.buffer, this.exports.row(y), 4 * width);
    return { pixels, work: new Uint32Array(this.buffer, this.exports.work(), width) };
  }

  report() {
    const start = this.exports.report();
    const numbers = new Float64Array(this.buffer, start, FIELDS.length);
    const report = Object.fromEntries(FIELDS.map((field, i) => [field, numbers[i]]));
    const parts = new Float64Array(this.buffer, start + 8 * FIELDS.length, 3 * report.parts);
    report.parts = Array.from({ length: report.parts }, (_, i) => {
      const [name, length, bytes] = parts.subarray(3 * i, 3 * i + 3);
      return { name: this.text(name, length), bytes };
    });
    return report;
  }
}

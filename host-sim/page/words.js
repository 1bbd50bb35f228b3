// Numbers and findings in words.

import { REASON, STOPPED, STRUCTURE } from "./engine.js";

const whole = new Intl.NumberFormat("en");
const some = new Intl.NumberFormat("en", { maximumSignificantDigits: 3 });
const short = new Intl.NumberFormat("en", { notation: "compact", maximumSignificantDigits: 3 });

export const count = (n) => whole.format(n);
export const rough = (n) => some.format(n);
export const compact = (n) => short.format(n);

export function bytes(n) {
  if (n < 10_000 && (n === 0 || n % 1024)) return `${count(n)} B`;
  const [value, unit] = n < 1 << 20 ? [n / 1024, "KiB"] : [n / (1 << 20), "MiB"];
  return `${value < 100 ? Number(value.toFixed(1)) : Math.round(value)} ${unit}`;
}

// What was built, and why.
export function built(report) {
  const kind = STRUCTURE[report.structure];
  if (kind === "none") {
    const all = `Every ray is tested against all ${count(report.shapes)} shapes`;
    if (report.reason === REASON.few) return `${all}: so few that no structure pays.`;
    if (report.reason === REASON.noMemory) {
      return `${all}: ${bytes(report.capacity)} hold no structure. The smallest takes ${bytes(report.needed)}.`;
    }
    return `${all}, as you asked.`;
  }
  if (kind === "grid") {
    return `A grid of ${report.nx} × ${report.ny} × ${report.nz} cells.`;
  }
  if (kind === "hierarchy") {
    const nodes = report.divided === 1 ? "node" : "nodes";
    return `A hierarchy of bounding boxes: ${count(report.divided)} ${nodes}.`;
  }
  const why = {
    done: "no cell has too many shapes",
    level: "cells cannot be smaller",
    memory: "the memory is used up",
  }[STOPPED[report.stoppedBy]];
  const cells = report.divided === 1 ? "cell" : "cells";
  return `An octree of ${count(report.divided)} divided ${cells}, ${report.maxLevel} levels deep: ${why}.`;
}

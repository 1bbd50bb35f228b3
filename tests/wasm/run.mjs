// Runs the module and prints a line of JSON: node run.mjs MODULE.wasm SCENE
import { readFile } from "node:fs/promises";

const hex = (sum) => (sum >>> 0).toString(16).padStart(8, "0");

const bytes = await readFile(process.argv[2]);
const module = await WebAssembly.compile(bytes);
const { exports } = await WebAssembly.instantiate(module, {});
const scene = Number(process.argv[3]);
console.log(
  JSON.stringify({
    scene,
    image_crc32: hex(exports.render(scene)),
    hits_crc32: hex(exports.hits(scene)),
    memory_bytes: exports.memory.buffer.byteLength,
    imports: WebAssembly.Module.imports(module).length,
  }),
);

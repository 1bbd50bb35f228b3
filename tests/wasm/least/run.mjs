// Runs the module and prints a line of JSON: node run.mjs MODULE.wasm
import { readFile } from "node:fs/promises";

const module = await WebAssembly.compile(await readFile(process.argv[2]));
const { exports } = await WebAssembly.instantiate(module, {});
console.log(
  JSON.stringify({
    image_crc32: (exports.render(64, 48) >>> 0).toString(16).padStart(8, "0"),
    memory_bytes: exports.memory.buffer.byteLength,
    imports: WebAssembly.Module.imports(module).length,
  }),
);

// compare.mjs MODULE.wasm NATIVE: runs the module and compares each of its numbers with what the program NATIVE prints.
//
// Laws made of arithmetic, square roots and fused multiply-adds alone agree to the bit. The others call exp, log, ... of
// two C libraries (musl here, glibc there, which itself differs between processors), each within an ulp or so;
// what iterates on them (the inverse of a mixture's cdf) gathers some.
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";

const identical = /^(isotropic|henyey_greenstein) /;
const bounds = [
  [/ float$/, 3e-7],  // relative
  [/./, 2e-14],
];

const [modulePath, native] = process.argv.slice(2);
const module = await WebAssembly.compile(readFileSync(modulePath));
// wasi-libc brings stdio along with snprintf; nothing is ever written. A page can give the same.
const refuse = (name) => () => { throw new Error(`the module called ${name}`); };
const imports = {};
for (const { module: from, name } of WebAssembly.Module.imports(module)) {
  if (!["fd_close", "fd_seek", "fd_write"].includes(name)) throw new Error(`the module wants ${from}.${name}`);
  (imports[from] ??= {})[name] = refuse(name);
}
const { exports: wasm } = await WebAssembly.instantiate(module, imports);
wasm._initialize();

const wanted = execFileSync(native, { encoding: "latin1", maxBuffer: 1 << 28 }).trimEnd().split("\n").map((line) => {
  const [name, words] = line.split("\t");
  const bits = new BigUint64Array(words.trim().split(" ").map((word) => BigInt("0x" + word)));
  return { name, bits, numbers: new Float64Array(bits.buffer) };
});
if (wasm.group_count() !== wanted.length) throw new Error(`${wasm.group_count()} groups, natively ${wanted.length}`);

let failed = false;
wanted.forEach(({ name, bits, numbers }, g) => {
  const at = wasm.values(g), count = wasm.value_count(g);
  const bytes = new Uint8Array(wasm.memory.buffer, wasm.group_name(g), name.length + 1);  // a view holds until memory grows
  const found = String.fromCharCode(...bytes.subarray(0, name.length));
  if (found !== name || bytes[name.length] !== 0 || count !== bits.length || count < 200) {
    throw new Error(`${found}, ${count} numbers; natively ${name}, ${bits.length}`);
  }
  const theirs = wasm.memory.buffer.slice(at, at + 8 * count);
  const theirBits = new BigUint64Array(theirs), theirNumbers = new Float64Array(theirs);
  let differing = 0, worst = 0, place = -1;
  for (let i = 0; i < count; ++i) {
    if (theirBits[i] === bits[i]) continue;
    ++differing;
    const error = Math.abs(theirNumbers[i] - numbers[i]) / Math.abs(numbers[i]);
    if (!(error <= worst)) [worst, place] = [error, i];
  }
  const bound = identical.test(name) ? 0 : bounds.find(([pattern]) => pattern.test(name))[1];
  const good = differing === 0 || worst <= bound;
  failed ||= !good;
  console.log(`${name.padEnd(26)} ${String(count).padStart(6)} numbers, ${String(differing).padStart(3)} differ, by at most ` +
    `${worst.toExponential(1)}${good ? "" : `: MORE THAN ${bound} at ${place}: ${theirNumbers[place]}, natively ${numbers[place]}`}`);
});
process.exitCode = failed ? 1 : 0;

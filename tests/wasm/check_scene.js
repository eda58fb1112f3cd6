// check_scene.js - runs the module that check_scene.cpp makes, and prints the line that run.sh puts in its table of targets:
// "target: KERNELS LOCAL_HASH SGM_HASH WAYS". Exit code 0: all hashes are golden, 1: one is not, 2: usage.
'use strict';
const fs = require('fs');

const path = process.argv[2];
if (process.argv.length !== 3) {
  console.error('usage: node check_scene.js FOLDER/check_scene.wasm');
  process.exit(2);
}

// No imports: a module that needs anything is refused here.
const module_ = new WebAssembly.Module(fs.readFileSync(path));
const { memory, scene_hash, golden_hash, kernel_name } = new WebAssembly.Instance(module_, {}).exports;

const hex = (hash) => BigInt.asUintN(64, hash).toString(16).padStart(16, '0');

function text_at(address) {
  const bytes = new Uint8Array(memory.buffer, address);
  return Buffer.from(bytes.subarray(0, bytes.indexOf(0))).toString();
}

// The instruction sets, the best first: what every mask of bsm_config allows, and scalar.
const sets = new Map();
for (const isa_mask of [0xffffffff, 0]) {
  const name = text_at(kernel_name(isa_mask)).replace(/.*_/, '');
  if (!sets.has(name)) sets.set(name, isa_mask);
}

const golden = [0, 1].map(golden_hash);  // by bsm_method: local, sgm
for (const [name, isa_mask] of sets) {
  for (const method of [0, 1]) {
    for (const by_rows of [0, 1]) {
      const hash = scene_hash(method, by_rows, isa_mask);
      if (hash === golden[method]) continue;
      console.error(`${name}, method ${method}, ${by_rows ? 'rows' : 'frame'}: ${hex(hash)} is not ${hex(golden[method])}`);
      process.exitCode = 1;
    }
  }
}
console.log('target:', [...sets.keys()].join('+'), ...golden.map(hex), 'frame+rows');

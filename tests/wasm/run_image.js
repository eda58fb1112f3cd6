// run_image.js - runs a module whose main function asks host.cpp for what it needs, such as check_kernels.wasm. Exit code: the
// module's, 1 when it stops without one.
'use strict';
const fs = require('fs');

const [path, ...words] = process.argv.slice(2);
if (!path) {
  console.error('usage: node run_image.js FOLDER/NAME.wasm [ARGUMENT]...');
  process.exit(2);
}

let memory;
const host = {
  print(address) {
    const bytes = new Uint8Array(memory.buffer, address);
    fs.writeSync(1, bytes.subarray(0, bytes.indexOf(0)));
  },
  // The image's name and its arguments, ended by a zero, when they fit.
  arguments(address, bytes) {
    const text = Buffer.from(['image', ...words].join(' ') + '\0');
    if (text.length > bytes) return 0;
    new Uint8Array(memory.buffer, address).set(text);
    return 1;
  },
  exit(code) {
    process.exit(code);
  },
};

const image = new WebAssembly.Instance(new WebAssembly.Module(fs.readFileSync(path)), { host }).exports;
memory = image.memory;
process.exitCode = 1;
image.run();

// The page's own WAV writer: `node write_wav.mjs PAGE SAMPLES RATE FILE`, SAMPLES in float64.

import { readFileSync, writeFileSync } from "node:fs";

const [page, samples, rate, file] = process.argv.slice(2);
const { wavOf } = await import(`${page}/js/views/measure/wav.js`);
const bytes = readFileSync(samples);
writeFileSync(file, Buffer.from(wavOf(new Float64Array(bytes.buffer, bytes.byteOffset, bytes.length / 8), Number(rate))));

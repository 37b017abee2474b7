/** A sound as a WAV file: one channel, 16 bits a sample. */

const HEADER = 44; // bytes
const FULL = 32767; // the largest sample

/** Return the bytes of a file with these samples, from -1 to 1; what is beyond is cut off. */
export function wavOf(samples, rate) {
  const bytes = new DataView(new ArrayBuffer(HEADER + 2 * samples.length));
  let place = 0;
  const word = (text) => [...text].forEach((letter) => bytes.setUint8(place++, letter.charCodeAt(0)));
  const number = (value, size) => {
    bytes[size === 2 ? "setUint16" : "setUint32"](place, value, true);
    place += size;
  };
  word("RIFF");
  number(HEADER - 8 + 2 * samples.length, 4);
  word("WAVEfmt ");
  number(16, 4); // bytes that describe the format
  number(1, 2); // whole numbers
  number(1, 2); // channel
  number(rate, 4);
  number(2 * rate, 4); // bytes a second
  number(2, 2); // bytes a sample
  number(16, 2); // bits a sample
  word("data");
  number(2 * samples.length, 4);
  samples.forEach((sample, i) => bytes.setInt16(HEADER + 2 * i, Math.round(FULL * Math.min(Math.max(sample, -1), 1)), true));
  return bytes.buffer;
}

// Unpacks LZMA, which makes the solver a quarter shorter than gzip does, the best that a browser unpacks by itself.
// Format: Pavlov, LZMA specification, 2015; here raw, with lc = 3, lp = pb = 0, to a length that is known.

/** Places of the adaptive probabilities, each list after the one before. */
const [MATCH, REPEATED, BESIDE_FIRST, LONG, BESIDE_SECOND, BESIDE_THIRD] = [0, 12, 24, 36, 48, 60];
const [SLOT, FAR, ALIGNED, LENGTH, LENGTH_REPEATED, LITERAL] = [72, 328, 456, 472, 746, 1020];
const ALL = LITERAL + 8 * 0x300;

/**
 * So many bytes of what is packed.
 * @param {Uint8Array} packed
 * @param {number} size
 */
export function unpackedLzma(packed, size) {
  const found = new Uint8Array(size);
  const probabilities = new Uint16Array(ALL).fill(1024);
  // whole 32-bit numbers, which engines box where they are variables of a closure
  const coder = new Uint32Array([0xffffffff, 0]);
  const [RANGE, CODE] = [0, 1];
  let read = 1, written = 0;
  while (read < 5) coder[CODE] = (coder[CODE] << 8) | packed[read++];

  const shifted = () => {
    if (coder[RANGE] >= 0x1000000) return;
    coder[RANGE] <<= 8;
    coder[CODE] = (coder[CODE] << 8) | packed[read++];
  };
  const bit = (/** @type {number} */ place) => {
    const probability = probabilities[place];
    const bound = (coder[RANGE] >>> 11) * probability;
    const one = coder[CODE] >= bound ? 1 : 0;
    if (one) {
      coder[RANGE] -= bound;
      coder[CODE] -= bound;
      probabilities[place] = probability - (probability >>> 5);
    } else {
      coder[RANGE] = bound;
      probabilities[place] = probability + ((2048 - probability) >>> 5);
    }
    shifted();
    return one;
  };
  /** Bits that are as likely as not. */
  const even = (/** @type {number} */ count) => {
    let value = 0;
    for (; count > 0; count--) {
      coder[RANGE] >>>= 1;
      const one = coder[CODE] >= coder[RANGE] ? 1 : 0;
      if (one) coder[CODE] -= coder[RANGE];
      value = 2 * value + one;
      shifted();
    }
    return value;
  };
  const tree = (/** @type {number} */ first, /** @type {number} */ bits) => {
    let node = 1;
    for (let i = 0; i < bits; i++) node = 2 * node + bit(first + node);
    return node - (1 << bits);
  };
  /** The same with the lowest bit first. */
  const reversed = (/** @type {number} */ first, /** @type {number} */ bits) => {
    let node = 1, value = 0;
    for (let i = 0; i < bits; i++) {
      const one = bit(first + node);
      node = 2 * node + one;
      value |= one << i;
    }
    return value;
  };
  const length = (/** @type {number} */ first) => {
    if (!bit(first)) return tree(first + 2, 3);
    return bit(first + 1) ? 16 + tree(first + 18, 8) : 8 + tree(first + 10, 3);
  };
  const far = (/** @type {number} */ slot) => {
    if (slot < 4) return slot;
    const bits = (slot >> 1) - 1;
    const least = (2 | (slot & 1)) * 2 ** bits;
    if (slot < 14) return least + reversed(FAR + least - slot, bits);
    return least + 16 * even(bits - 4) + reversed(ALIGNED, 4);
  };

  // how far back the last four repetitions began
  let first = 0, second = 0, third = 0, fourth = 0;
  let state = 0;
  while (written < size) {
    if (!bit(MATCH + state)) {
      const places = LITERAL + 0x300 * (written > 0 ? found[written - 1] >> 5 : 0);
      let node = 1;
      if (state >= 7) {
        // after a repetition the byte that would go on with it is not the next one
        let other = found[written - first - 1];
        let alike = true;
        while (node < 0x100 && alike) {
          const expected = other >> 7;
          other = (other << 1) & 0xff;
          const one = bit(places + 0x100 + 0x100 * expected + node);
          node = 2 * node + one;
          alike = one === expected;
        }
      }
      while (node < 0x100) node = 2 * node + bit(places + node);
      found[written++] = node;
      state = state < 4 ? 0 : state < 10 ? state - 3 : state - 6;
      continue;
    }
    let count;
    if (!bit(REPEATED + state)) {
      [second, third, fourth] = [first, second, third];
      count = length(LENGTH);
      first = far(tree(SLOT + 64 * Math.min(count, 3), 6));
      state = state < 7 ? 7 : 10;
    } else {
      if (bit(BESIDE_FIRST + state)) {
        const before = first;
        if (!bit(BESIDE_SECOND + state)) first = second;
        else {
          if (!bit(BESIDE_THIRD + state)) first = third;
          else {
            first = fourth;
            fourth = third;
          }
          third = second;
        }
        second = before;
      } else if (!bit(LONG + state)) {
        found[written] = found[written - first - 1];
        written++;
        state = state < 7 ? 9 : 11;
        continue;
      }
      count = length(LENGTH_REPEATED);
      state = state < 7 ? 8 : 11;
    }
    for (const end = Math.min(written + count + 2, size); written < end; written++) {
      found[written] = found[written - first - 1];
    }
  }
  return found;
}

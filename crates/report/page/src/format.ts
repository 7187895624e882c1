/** A number as people read it and can paste it: `digits` significant ones, in ASCII. */
export function short(value: number, digits = 4): string {
  if (!Number.isFinite(value)) return "\u2013";
  const size = Math.abs(value);
  if (size < 1e-9) return "0";
  return size < 1e-3 || size >= 1e5 ? value.toExponential(1) : fixed(value, size, digits);
}

function fixed(value: number, size: number, digits: number): string {
  const decimals = Math.min(Math.max(digits - 1 - Math.floor(Math.log10(size)), 0), digits);
  return value.toFixed(decimals);
}

/** A time on a clock that runs to `duration`, s. */
export function clock(time: number, duration: number): string {
  return time.toFixed(duration < 1000 ? 2 : 0);
}

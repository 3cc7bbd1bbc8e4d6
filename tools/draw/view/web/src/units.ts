// Formats numbers with SI prefixes.
const PREFIXES: [number, string][] = [[1e9, "G"], [1e6, "M"], [1e3, "k"], [1, ""], [1e-3, "m"], [1e-6, "µ"], [1e-9, "n"]];
const PREFIXED = new Set(["m", "m/s", "Pa", "s", "J", "N", "W"]);

export interface Scaled {
  factor: number; // divide values by this
  unit: string;
}

// The prefixed unit in which a number of this size has one to three digits before the decimal point, where a prefix
// allows it. Units that take no prefix stay unchanged, with factor 1.
export function scaled(unit: string, largest: number): Scaled {
  const size = Math.abs(largest);
  if (!PREFIXED.has(unit) || !(size > 0) || !Number.isFinite(size)) return { factor: 1, unit };
  const allowed = PREFIXES.filter(([factor]) => unit !== "s" || factor <= 1);
  const [factor, letter] = allowed.find(([f]) => size >= f * 0.9999) ?? (allowed[allowed.length - 1] as [number, string]);
  return { factor, unit: letter + unit };
}

// Formats a number with `digits` significant digits. The default, 3, is the precision of half floats.
export function formatted(value: number, digits = 3): string {
  if (!Number.isFinite(value)) return Number.isNaN(value) ? "not a number" : value > 0 ? "∞" : "−∞";
  if (value === 0) return "0";
  const size = Math.abs(value);
  const text = size >= 1e5 || size < 1e-3 ? value.toExponential(digits - 1) : value.toPrecision(digits);
  return text.replace("-", "−").replace("e+", "e");
}

// Formats a round number without trailing zeros, with at most six significant digits.
export function round(value: number): string {
  const size = Math.abs(value), plain = Number(value.toPrecision(6));
  return (size !== 0 && (size >= 1e5 || size < 1e-3) ? plain.toExponential() : String(plain)).replace("-", "−").replace("e+", "e");
}

export function withUnit(value: number, unit: string, digits = 3): string {
  const s = scaled(unit, value), text = formatted(value / s.factor, digits);
  return s.unit && s.unit !== "1" ? `${text} ${s.unit}` : text;
}

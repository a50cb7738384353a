// Figures as people read them. Every function takes what may be missing and then gives a dash.

const kDash = "–";
const thousands = new Intl.NumberFormat("en", { useGrouping: true });

export function milliseconds(value: number | undefined): string {
  if (value === undefined || !Number.isFinite(value)) return kDash;
  return `${value.toFixed(value < 10 ? 1 : 0)} ms`;
}

export function count(value: bigint | number | undefined): string {
  // A narrow no-break space between thousands is neither a decimal point nor a comma in any country.
  return value === undefined ? kDash : thousands.format(value).replaceAll(",", "\u202f");
}

export function factor(value: number | undefined): string {
  if (value === undefined || !Number.isFinite(value)) return kDash;
  return `${value < 0.1 ? value.toFixed(3) : value < 10 ? value.toFixed(2) : value.toFixed(1)}×`;
}

/** 0.0005 → "0.050 %" */
export function percent(fraction: number | undefined): string {
  if (fraction === undefined || !Number.isFinite(fraction)) return kDash;
  const value = 100 * fraction;
  return `${value < 1 ? value.toFixed(3) : value < 10 ? value.toFixed(2) : value.toFixed(1)} %`;
}

export function seconds(value: number | undefined): string {
  return value === undefined ? kDash : `${value.toFixed(2)} s`;
}

export function bytesPerSecond(value: number): string {
  return value >= 1e6 ? `${(value / 1e6).toFixed(1)} MB/s` : `${Math.round(value / 1e3)} kB/s`;
}

/** Three significant digits, with the unit's prefix where it saves zeros: "1.24 kJ", "310 mJ". */
export function joules(value: number | undefined): string {
  if (value === undefined || !Number.isFinite(value)) return kDash;
  const size = Math.abs(value);
  const [divisor, unit] = size >= 1e6 ? [1e6, "MJ"] : size >= 1e3 ? [1e3, "kJ"] : size >= 1 || size === 0 ? [1, "J"] : [1e-3, "mJ"];
  return `${threeDigits(value / divisor)} ${unit}`;
}

export function perSecond(value: number | undefined): string {
  return value === undefined || !Number.isFinite(value) ? kDash : `${threeDigits(value)} /s`;
}

/** Counts of iterations: medians may end in a half. */
export function iterations(value: number | undefined): string {
  return value === undefined || !Number.isFinite(value) ? kDash : String(Number(value.toFixed(1)));
}

/** 12.3, 1.23, 123; a value below 0.0005 is 0. */
function threeDigits(value: number): string {
  const size = Math.abs(value);
  if (size < 0.0005) return "0";
  return value.toFixed(size >= 100 ? 0 : size >= 10 ? 1 : size >= 1 ? 2 : 3).replace(/^-/, "−");
}

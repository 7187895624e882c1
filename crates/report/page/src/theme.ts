/** The colours of the page, from its style sheet, in the scheme that the reader prefers. */
export function color(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

/** The colour of joint i wherever it appears, counted from zero. */
export function jointColor(joint: number): string {
  return color(`joint-${joint % 7}`);
}

export const AXIS_COLORS = ["x", "y", "z"] as const;

export function onThemeChange(listener: () => void): void {
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", listener);
}

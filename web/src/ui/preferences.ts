// What this browser remembers of the viewer's choices. Storage may be forbidden; then nothing is remembered.

const kPrefix = "sluice.";

export function remembered(name: string): string | undefined {
  try {
    return localStorage.getItem(kPrefix + name) ?? undefined;
  } catch {
    return undefined;
  }
}

export function remember(name: string, value: string): void {
  try {
    localStorage.setItem(kPrefix + name, value);
  } catch {
    // Private windows forbid it; the choice then lasts as long as the page.
  }
}

// Line icons on a grid of 16, drawn with the text's colour.

const kPaths = {
  play: "M5 3.2v9.6l7.6-4.8z",
  pause: "M5.2 3.5v9M10.8 3.5v9",
  step: "M4 3.6v8.8l6-4.4zM12.2 3.6v8.8",
  toStart: "M12 3.6v8.8L6 8zM3.8 3.6v8.8",
  view: "M2.5 6V3.5a1 1 0 0 1 1-1H6M10 2.5h2.5a1 1 0 0 1 1 1V6M13.5 10v2.5a1 1 0 0 1-1 1H10M6 13.5H3.5a1 1 0 0 1-1-1V10M8 6.6a1.4 1.4 0 1 0 0 2.8 1.4 1.4 0 0 0 0-2.8z",
  save: "M8 2.5v7.2M4.9 6.9 8 10l3.1-3.1M2.8 13.2h10.4",
  panel: "M2 4.5h5.6M11.4 4.5H14M2 11.5h2.6M8.4 11.5H14M9.5 2.8a1.7 1.7 0 1 0 0 3.4 1.7 1.7 0 0 0 0-3.4zM6.5 9.8a1.7 1.7 0 1 0 0 3.4 1.7 1.7 0 0 0 0-3.4z",
  undo: "M3 7.2h6.4a3.1 3.1 0 1 1 0 6.2H6.5M5.6 4.4 2.8 7.2 5.6 10",
  turn: "M13.6 8c0 1.6-2.5 2.8-5.6 2.8S2.4 9.6 2.4 8 4.9 5.2 8 5.2c1.2 0 2.3.2 3.2.5M9.4 3.2l2 2.5-2.8 1.6",
  push: "M2.4 8h7.2M6.6 5l3 3-3 3M13.2 3.4v9.2",
  pull: "M13.4 8H6.2M9.2 5l-3 3 3 3M2.8 3.4v9.2",
  add: "M6.8 2.8S3 6.8 3 9.5a3.8 3.8 0 0 0 7.6 0c0-.5-.1-1-.3-1.5M11.8 2.4v4.8M9.4 4.8h4.8",
  pick: "M8 1.8v3.4M8 10.8v3.4M1.8 8h3.4M10.8 8h3.4M8 7.3a.7.7 0 1 0 0 1.4.7.7 0 0 0 0-1.4z",
  close: "M4 4l8 8M12 4l-8 8",
} as const;

export type IconName = keyof typeof kPaths;

const kSvg = "http://www.w3.org/2000/svg";

export function icon(name: IconName, size = 16): SVGSVGElement {
  const svg = document.createElementNS(kSvg, "svg");
  const attributes = { viewBox: "0 0 16 16", width: size, height: size, "aria-hidden": true, class: "icon" };
  for (const [key, value] of Object.entries(attributes)) svg.setAttribute(key, String(value));
  const path = document.createElementNS(kSvg, "path");
  path.setAttribute("d", kPaths[name]);
  svg.append(path);
  return svg;
}

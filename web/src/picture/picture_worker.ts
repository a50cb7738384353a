// The pipeline in a worker: neither a busy page delays pictures, nor do pictures delay the page.

import { Pipeline, type PipelineOrder, type PipelineReport } from "./pipeline";

let pipeline: Pipeline | undefined;

addEventListener("message", ({ data: order }: MessageEvent<PipelineOrder>) => {
  switch (order.kind) {
    case "start": {
      const ahead = performance.timeOrigin - order.timeOrigin;
      pipeline = new Pipeline(order.canvas, (report) => postMessage(onPageClock(report, ahead)));
      break;
    }
    case "picture":
      pipeline?.push(order.picture);
      break;
    case "reset":
      pipeline?.reset();
      break;
  }
});

function onPageClock(report: PipelineReport, ahead: number): PipelineReport {
  if (report.kind !== "drawn") return report;
  return { ...report, decodedAt: report.decodedAt + ahead, drawnAt: report.drawnAt + ahead };
}

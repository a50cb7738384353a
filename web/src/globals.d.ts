import type { App } from "./app";

declare global {
  interface Window {
    /** Read-only facts about the page, for tests and the curious. */
    readonly sluice: { facts(): ReturnType<App["facts"]> };
  }
}

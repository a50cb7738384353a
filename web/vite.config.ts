import { defineConfig } from "vitest/config";

export default defineConfig({
  build: {
    target: "es2022",
    // Every file stands by itself, so that a content policy of 'self' is enough.
    assetsInlineLimit: 0,
    modulePreload: false,
  },
  server: {
    // `npm run dev` shows the page of the sources with a server that runs on its usual port.
    proxy: { "/stream": { target: "ws://127.0.0.1:8080", ws: true, changeOrigin: true, rewriteWsOrigin: true } },
  },
  test: {
    include: ["test/**/*.test.ts"],
  },
});

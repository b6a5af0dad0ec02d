import { defineConfig } from "vite";

// One script and one style sheet, to be put into the page as they are.
export default defineConfig({
  build: {
    lib: { entry: "src/report.ts", formats: ["iife"], name: "probewrightReport", fileName: () => "report.js", cssFileName: "report" },
    target: "es2022",
    emptyOutDir: true,
    reportCompressedSize: false,
  },
  logLevel: "warn",
});

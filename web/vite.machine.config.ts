import { defineConfig } from "vite";

// The page of `probewright machine`, beside that of the report.
export default defineConfig({
  build: {
    lib: { entry: "src/machine_page.ts", formats: ["iife"], name: "probewrightMachine", fileName: () => "machine.js", cssFileName: "machine" },
    target: "es2022",
    emptyOutDir: false,
    reportCompressedSize: false,
  },
  logLevel: "warn",
});

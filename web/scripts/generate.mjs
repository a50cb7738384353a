// Writes src/gen from the protocol's schema, with Debian's protoc and the protobuf-es plugin of node_modules.
import { execFileSync } from "node:child_process";
import { mkdirSync, readdirSync, rmSync } from "node:fs";
import { fileURLToPath } from "node:url";

const path = (relative) => fileURLToPath(new URL(relative, import.meta.url));
const schemas = path("../../proto");
const out = path("../src/gen");

const files = readdirSync(`${schemas}/sluice/v1`)
  .filter((name) => name.endsWith(".proto"))
  .map((name) => `sluice/v1/${name}`);

rmSync(out, { recursive: true, force: true });
mkdirSync(out, { recursive: true });
execFileSync(
  "protoc",
  [
    `--plugin=protoc-gen-es=${path("../node_modules/.bin/protoc-gen-es")}`,
    `--proto_path=${schemas}`,
    `--es_out=${out}`,
    "--es_opt=target=ts",
    ...files,
  ],
  { stdio: "inherit" },
);

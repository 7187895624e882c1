// Bundles the pages into dist/, which is committed: building the program needs no Node.
// `node build.mjs` writes, `node build.mjs --check` compares with what is there.
import { createHash } from "node:crypto";
import { readFileSync, readdirSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const root = dirname(fileURLToPath(import.meta.url));
const read = (name) => readFileSync(join(root, name), "utf8");

// The digest that a test of the report crate computes again from the sources.
const sources = [
  "build.mjs",
  "package-lock.json",
  "package.json",
  "tsconfig.json",
  ...readdirSync(join(root, "src")).sort().map((name) => `src/${name}`),
];
const digest = createHash("sha256");
for (const name of sources) digest.update(`${name}\n`).update(read(name));

const licences = ["three", "uplot"].map(
  (name) => `${name}\n\n${read(`node_modules/${name}/LICENSE`).trim()}`,
);
const banner = `/*! Generated from sources ${digest.digest("hex")} */`;

const { outputFiles } = await build({
  absWorkingDir: root,
  entryPoints: ["src/report.ts", "src/compare.ts", "src/slews.ts"],
  outdir: "dist",
  bundle: true,
  minify: true,
  write: false,
  charset: "utf8",
  target: ["es2022", "chrome110", "firefox115", "safari16.4"],
  legalComments: "none",
  banner: { js: `${banner}\n/*!\n${licences.join("\n\n")}\n*/`, css: banner },
});

let stale = 0;
for (const { path, text } of outputFiles) {
  const name = path.slice(root.length + 1);
  if (!process.argv.includes("--check")) {
    writeFileSync(path, text);
    console.log(`${name} ${text.length} bytes`);
  } else if (read(name) !== text) {
    console.error(`${name} is not what its sources make: run \`make page\``);
    stale = 1;
  }
}
process.exit(stale);

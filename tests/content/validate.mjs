// Runs the Khronos glTF validator over files: node validate.mjs <folder of node_modules> file...
// Prints errors, warnings and infos of each file; exit code 1 when any file has an error or an unexplained
// warning, 2 when the validator cannot be loaded.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { basename, join } from "node:path";

const [modules, ...files] = process.argv.slice(2);
let validator;
try {
    validator = createRequire(join(modules, "node_modules", "x.js"))("gltf-validator");
} catch (error) {
    console.error(`gltf-validator cannot be loaded from '${modules}': ${error.message}`);
    process.exit(2);
}

// The validator does not know these extensions and says so; nothing else may pass unseen.
const unknownToValidator = ["EXT_lights_area", "EXT_lights_ies"];
const explained = (m) =>
    m.code === "UNSUPPORTED_EXTENSION" && unknownToValidator.some((name) => m.message.includes(`'${name}'`));

let failed = false;
for (const file of files) {
    const report = await validator.validateBytes(new Uint8Array(readFileSync(file)), {
        uri: basename(file),
        maxIssues: 1000,
        writeTimestamp: false,
    });
    const issues = report.issues;
    console.log(
        `${basename(file)}: ${issues.numErrors} errors, ${issues.numWarnings} warnings, ` +
            `${issues.numInfos} infos, ${issues.numHints} hints`,
    );
    for (const m of issues.messages.slice(0, 30)) {
        const note = explained(m) ? " (expected)" : "";
        console.log(`  ${["error", "warning", "info", "hint"][m.severity]} ${m.code} ${m.pointer ?? ""}: ${m.message}${note}`);
    }
    const bad = issues.messages.filter((m) => m.severity <= 1 && !explained(m));
    failed ||= issues.numErrors > 0 || bad.length > 0 || issues.truncated;
}
process.exit(failed ? 1 : 0);

// Rules that need types find what the compiler accepts: promises that nobody awaits, tests that are always true.
import js from "@eslint/js";
import { defineConfig } from "eslint/config";
import typescript from "typescript-eslint";

export default defineConfig(
    { ignores: ["dist"] },
    js.configs.recommended,
    typescript.configs.strictTypeChecked,
    {
        languageOptions: { parserOptions: { projectService: true, tsconfigRootDir: import.meta.dirname } },
        rules: {
            "@typescript-eslint/restrict-template-expressions": ["error", { allowNumber: true }],
            "@typescript-eslint/no-confusing-void-expression": [
                "error",
                { ignoreArrowShorthand: true, ignoreVoidReturningFunctions: true },
            ],
        },
    },
    // This file belongs to no TypeScript project.
    { files: ["*.js"], extends: [typescript.configs.disableTypeChecked] },
);

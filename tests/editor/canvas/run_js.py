"""Evaluates expressions on the pure modules of the canvas in the node of Playwright, without a browser."""

import json
import subprocess
from pathlib import Path
from typing import Any

import playwright

NODE = Path(playwright.__file__).parent / "driver" / "node"
JS = Path(__file__).parents[3] / "vicode/editor/canvas/js"
# What text_metrics.js needs at import.
STUBS = "globalThis.document = { fonts: { load: async () => [] } };"


def run_js(module: str, names: str, expression: str, *arguments: object) -> Any:
    """Import `names` from a module and return the value of an expression, in which `args` are the arguments."""
    source = f"""
        {STUBS}
        const {{ {names} }} = await import("file://{JS}/{module}");
        const args = {json.dumps(arguments)};
        console.log(JSON.stringify({expression}));
    """
    options = ["--no-warnings", "--experimental-detect-module", "--input-type=module", "--eval", source]
    done = subprocess.run([NODE, *options], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)

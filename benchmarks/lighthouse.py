"""`python -m benchmarks.lighthouse`: what Google's Lighthouse says of the documentation site, as a telephone sees it.

It comes through npm's `npx` and drives the Chromium of the system. A page's scores are the medians of several runs,
since everything else that the machine does makes a page look slower.
"""

import argparse
import functools
import gzip
import http.server
import json
import os
import shutil
import subprocess
import sys
import tempfile
import threading
from pathlib import Path
from statistics import median

from vicode.cli import main as vicode

PAGES = ("index.html", "component-Player.html", "symbols.html", "source-Player.html")
CATEGORIES = ("performance", "accessibility", "best-practices", "seo")
LIGHTHOUSE = "lighthouse@12"


class Handler(http.server.SimpleHTTPRequestHandler):
    """Serves a folder as web hosts do: compressed."""

    def log_message(self, format: str, *args: object) -> None:  # noqa: A002  # the name that it overrides
        """Says nothing."""

    def do_GET(self) -> None:
        """A file, compressed."""
        path = Path(self.translate_path(self.path))
        if not path.is_file():
            self.send_error(404)
            return
        body = gzip.compress(path.read_bytes())
        self.send_response(200)
        self.send_header("Content-Type", self.guess_type(str(path)))
        self.send_header("Content-Encoding", "gzip")
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)


def run_lighthouse(address: str, chromium: str) -> dict[str, float]:
    """The scores of one run, by category."""
    flags = "--headless=new --no-sandbox"
    command = ["npx", "--yes", LIGHTHOUSE, address, "--quiet", "--output=json", f"--chrome-flags={flags}"]
    command.append(f"--only-categories={','.join(CATEGORIES)}")
    environment = {**os.environ, "CHROME_PATH": chromium}
    done = subprocess.run(command, capture_output=True, text=True, check=True, env=environment, timeout=300)
    categories = json.loads(done.stdout)["categories"]
    return {name: 100 * categories[name]["score"] for name in CATEGORIES}


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("path", nargs="?", default="designs/forward", help="what `vicode docs` takes")
    parser.add_argument("--pages", nargs="+", default=PAGES, metavar="FILE")
    parser.add_argument("--runs", type=int, default=3)
    args = parser.parse_args()
    chromium = shutil.which("chromium") or shutil.which("google-chrome")
    if not chromium or not shutil.which("npx"):
        print("Chromium and npx are needed", file=sys.stderr)
        return 2
    with tempfile.TemporaryDirectory() as folder:
        vicode(["docs", args.path, "--out", folder])
        server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Handler, directory=folder))
        threading.Thread(target=server.serve_forever, daemon=True).start()
        print(f"{'':32}" + "".join(f"{name:>16}" for name in CATEGORIES))
        for page in args.pages:
            address = f"http://127.0.0.1:{server.server_port}/{page}"
            runs = [run_lighthouse(address, chromium) for _run in range(args.runs)]
            found = [round(median(run[name] for run in runs)) for name in CATEGORIES]
            print(f"{page:32}" + "".join(f"{score:>16}" for score in found))
        server.shutdown()
    return 0


if __name__ == "__main__":
    sys.exit(main())

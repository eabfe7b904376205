#!/usr/bin/env python3
"""Compiles the f32 shader by Tint, in a headless Chromium, on a device of WebGPU's default limits:

    benches/portability/tint.py

It wants cargo, and Chromium as `chromium` or as $CHROMIUM says. The exit status is 1 where a text is
refused, or where the control is not."""

import http.server
import json
import os
import queue
import subprocess
import sys
import tempfile
import threading
from pathlib import Path

HERE = Path(__file__).resolve().parent
TEXTS = ["cargo", "bench", "--quiet", "--profile", "dev", "--bench", "shader_text"]
CHROMIUM = [os.environ.get("CHROMIUM", "chromium"), "--headless", "--no-sandbox", "--no-first-run",
            "--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader"]
# Longest wait for a report, seconds.
PATIENCE = 600
# A barrier that some threads of a group may miss: WGSL forbids it.
CONTROL = """
@compute @workgroup_size(64)
fn control(@builtin(local_invocation_index) local: u32) {
    if local == 0u { workgroupBarrier(); }
}
"""


def serve(texts, reports):
    """A server of the page and of the texts; it takes the report."""

    class Handler(http.server.BaseHTTPRequestHandler):
        def do_GET(self):
            pages = {"/": ("text/html", (HERE / "tint.html").read_bytes()),
                     "/texts": ("application/json", json.dumps(texts).encode())}
            kind, body = pages.get(self.path, (None, b""))
            self.send_response(200 if kind else 404)
            self.send_header("Content-Type", kind or "text/plain")
            self.end_headers()
            self.wfile.write(body)

        def do_POST(self):
            body = self.rfile.read(int(self.headers["Content-Length"]))
            self.send_response(204)
            self.end_headers()
            reports.put(json.loads(body))

        def log_message(self, *_):
            pass

    return http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)


def report_on(texts):
    """What the page says of the texts."""
    reports = queue.Queue()
    server = serve(texts, reports)
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        url = f"http://127.0.0.1:{server.server_port}/"
        with subprocess.Popen([*CHROMIUM, f"--user-data-dir={profile}", url],
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as browser:
            threading.Thread(target=server.serve_forever, daemon=True).start()
            try:
                return reports.get(timeout=PATIENCE)
            except queue.Empty:
                return {"error": f"no report within {PATIENCE} s"}
            finally:
                browser.terminate()


def main():
    texts = json.loads(subprocess.run(TEXTS, check=True, stdout=subprocess.PIPE, cwd=HERE).stdout)
    control = {"name": "control", "source": texts[0]["source"] + CONTROL, "kernels": ["control"],
               "constants": {}}
    report = report_on([*texts, control])
    if "error" in report:
        sys.exit(report["error"])
    print(f"{report['browser']}, {report['adapter']}")
    for verdict in report["verdicts"]:
        seconds = ", ".join(f"{name} {took:.1f} s" for name, took in verdict["seconds"].items())
        print(f"{verdict['name']}: {'accepted' if verdict['accepted'] else 'refused'} {seconds}")
        for message in verdict["messages"]:
            print(f"    {message}")
    print("limits, nearest first:")
    needs = {}
    for text in texts:
        for limit, amount in text["needs"].items():
            needs[limit] = max(amount, needs.get(limit, 0))
    limits = report["limits"]
    for limit, amount in sorted(needs.items(), key=lambda need: -need[1] / limits[need[0]]):
        print(f"    {limit}: {amount} of {limits[limit]}")
    *shaders, control = [verdict["accepted"] for verdict in report["verdicts"]]
    sys.exit(0 if all(shaders) and not control else 1)


if __name__ == "__main__":
    main()

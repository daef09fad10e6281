"""The page in headless Chromium: no message on the console, nothing wider than the screen, scripts run."""

import html
import re
import shutil
import subprocess

import pytest

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
pytestmark = pytest.mark.skipif(CHROMIUM is None, reason="needs Chromium (Debian: chromium)")
WIDTHS = (390, 1280)

# The page in frames of both widths, which tell their scroll widths and whether the view was drawn.
FRAMES = """<!DOCTYPE html><title>frames</title>
{frames}
<script>
addEventListener("load", () => setTimeout(() => {{
  for (const frame of document.querySelectorAll("iframe")) {{
    const page = frame.contentDocument, root = page.documentElement, canvas = page.querySelector("canvas");
    const colours = new Set(new Uint32Array(
      canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data.buffer));
    page.querySelector("[data-view=top]").click();
    const select = page.querySelector("#poses select"), kappa = () => page.getElementById("kappa").textContent;
    const first = kappa();
    select.value = 1;
    select.dispatchEvent(new Event("change"));
    document.body.append(`[${{[frame.width, root.scrollWidth, root.clientWidth, root.dataset.scene, colours.size > 8,
      first !== kappa()].join(" ")}}]`);
  }}
}}, 100));
</script>"""


def chromium(path, *options):
    command = [CHROMIUM, "--headless", "--no-sandbox", "--disable-gpu", "--enable-logging=stderr", *options]
    done = subprocess.run([*command, f"file://{path}"], capture_output=True, text=True, timeout=120, check=True)
    assert "CONSOLE" not in done.stderr, [line for line in done.stderr.splitlines() if "CONSOLE" in line]
    return done.stdout


def test_nothing_overflows_and_the_view_is_drawn_at_phone_and_desktop_width(page, tmp_path):
    inside = html.escape(page.read_text(encoding="utf-8"), quote=True)
    frames = "\n".join(f'<iframe width="{width}" height="800" srcdoc="{inside}"></iframe>' for width in WIDTHS)
    (tmp_path / "frames.html").write_text(FRAMES.format(frames=frames), encoding="utf-8")
    shown = chromium(tmp_path / "frames.html", "--window-size=1800,2000", "--dump-dom", "--virtual-time-budget=3000")
    told = re.findall(r"\[(\d+) (\d+) (\d+) (\w+) (\w+) (\w+)\]", shown.rpartition("</iframe>")[2])
    assert [int(row[0]) for row in told] == list(WIDTHS)
    for _, scroll, client, scene, drawn, changed in told:
        assert int(scroll) <= int(client)
        assert (scene, drawn, changed) == ("ready", "true", "true")

"""Pages of records, folders and figures that a stranger made: nothing of them runs, nothing is asked for."""

import json
import random
import re
import shutil
from html.parser import HTMLParser

import chromium
import pytest
from changed_files import entries_of, write_sealed

import ninedof as nd
from ninedof.cli.app import main
from ninedof.report import page
from ninedof.tables.html import tag

HOSTILE = (
    "<script>window.ran=1</script>",
    "</script><script>window.ran=1</script>",
    "</title></style></textarea><script>window.ran=1</script>",
    '"><img src=x onerror=window.ran=1>',
    "'><svg/onload=window.ran=1>",
    "<!--",
    "--><b>",
    "]]><![CDATA[",
    "</",
    "\u2028window.ran=1\u2029",
    "javascript:window.ran=1",
    "<base href=//evil.example><meta http-equiv=refresh content=0;url=//evil.example>",
    "&lt;script&gt;&amp;&#60;",
    "$scene ${headline} {0} %s",
    "\x1b]0;evil\x07\x00\x9b31m",
    "\u202egnp.exe\u2066",
    "\ud800 half",
    "=cmd|' /C calc'!A0",
    "$\\frac{",
    "x" * 5000,
)
SHOWN = "javascript:window.ran=1"  # as text


class Structure(HTMLParser):
    """Elements with the names of their attributes, and what attributes point to."""

    def __init__(self, text):
        super().__init__(convert_charrefs=True)
        self.parts, self.targets = [], []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attrs):
        self.parts.append((tag, *(name for name, _ in attrs)))
        self.targets += [value for name, value in attrs if name in ("src", "href", "action", "data")]

    def handle_endtag(self, tag):
        self.parts.append(f"/{tag}")

    def handle_comment(self, data):
        self.parts.append("comment")

    def unknown_decl(self, data):
        self.parts.append("declaration")


def paths(value, at=()):
    """The places of strings and of names in plain values."""
    if isinstance(value, dict):
        for key, inner in value.items():
            yield (*at, key), "name"
            yield from paths(inner, (*at, key))
    elif isinstance(value, list):
        for k, inner in enumerate(value):
            yield from paths(inner, (*at, k))
    elif isinstance(value, str):
        yield at, "value"


def changed(record, path, kind, text):
    record = json.loads(json.dumps(record))
    inner = record
    for key in path[:-1]:
        inner = inner[key]
    if kind == "name":
        inner[text] = inner.pop(path[-1])
    else:
        inner[path[-1]] = text
    return record


def rendered(folder):
    """The structure of the page of a run, None where there is none."""
    try:
        return Structure(nd.report(folder).read_text(encoding="utf-8"))
    except (ValueError, LookupError, TypeError, AttributeError):
        return None


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    """A sweep, a motion and an atlas: their pages are read from the record alone."""
    place = tmp_path_factory.mktemp("hostile")
    home = ["--lc", "1", "--no-figures", "--no-report"]
    for name, asked in (
        ("sweep", ["sweep", "--over", "x_p=-1:1:3", "--no-figures", "--no-report"]),
        ("path", ["path", "--circle", "0.3", "--points", "9", *home]),
        ("atlas", ["atlas", "--designs", "200", "--no-figures", "--no-report"]),
    ):
        with pytest.raises(SystemExit) as ended:
            main([*asked, "--out", str(place / name)])
        assert ended.value.code in (0, 3)
    return {name: place / name for name in ("sweep", "path", "atlas")}


@pytest.mark.slow(sanitized=True)
@pytest.mark.parametrize("name", ["sweep", "path", "atlas"])
def test_no_string_of_a_record_becomes_structure(runs, tmp_path, name):
    chance = random.Random(16)
    record = entries_of(runs[name] / "record.json")
    places = list(paths(record))
    made = refused = 0
    for text in HOSTILE * 3:
        path, kind = chance.choice(places)
        found = []
        for word in (text, "zzz"):
            folder = tmp_path / "run"
            shutil.rmtree(folder, ignore_errors=True)
            shutil.copytree(runs[name], folder)
            write_sealed(folder / "record.json", changed(record, path, kind, word))
            found.append(rendered(folder))
        hostile, plain = found
        assert (hostile is None) == (plain is None), (path, kind, text)
        if hostile is None:
            refused += 1
            continue
        made += 1
        assert hostile.parts == plain.parts, (path, kind, text)
        assert all(target.startswith(("data:", "#")) for target in hostile.targets)
    assert made > 10
    assert made + refused == 3 * len(HOSTILE)


def test_characters_that_act_are_shown():
    assert tag("p", "a\x1b[2J\u202eb\ud800\x00", title="\x9b\u2066") == (
        '<p title="\\x9b\\u2066">a\\x1b[2J\\u202eb\\ud800\\x00</p>'
    )
    assert tag("p", "é 中 \n") == "<p>é 中 \n</p>"


def test_a_figure_is_a_file_of_its_folder(runs, tmp_path, monkeypatch):
    """A page is sent by mail: a link to a file of its sender would go with it."""
    folder = tmp_path / "run"
    shutil.copytree(runs["sweep"], folder)
    (tmp_path / "secret.svg").write_text("<svg>secret</svg>")
    (folder / "mine.svg").symlink_to(tmp_path / "secret.svg")
    (folder / "gone.svg").symlink_to(tmp_path / "gone.svg")
    (folder / "folder.svg").mkdir()
    (folder / "large.svg").write_text("<svg>" + 200 * " " + "</svg>")
    (folder / "own.svg").write_text("<svg></svg>")
    monkeypatch.setattr(page, "LARGEST", 100)
    assert page.stems(folder) == ["own"]
    text = nd.report(folder).read_text()
    assert text.count("data:image/svg+xml") == 1


needs_chromium = pytest.mark.skipif(chromium.PROGRAM is None, reason="needs the program chromium")
USED = """(async () => {
  const box = document.getElementById("view"), canvas = box.querySelector("canvas"), seen = [];
  const frame = () => new Promise(requestAnimationFrame);
  const drawn = async () => (await frame(), await frame(), canvas.toDataURL());
  const after = async (name, act) => {
    const before = await drawn();
    act();
    if ((await drawn()) === before) seen.push(name);
  };
  for (const one of box.querySelectorAll("[data-view]:not([data-view=home]), [data-zoom]"))
    await after(one.textContent, () => one.click());
  for (const one of box.querySelectorAll("[data-show]"))
    if (!one.parentElement.hidden) await after(one.dataset.show, () => one.click());
  const key = (key) => canvas.dispatchEvent(new KeyboardEvent("keydown", { key, cancelable: true }));
  await after("home", () => box.querySelector("[data-view=home]").click());
  for (const name of ["ArrowLeft", "ArrowUp", "+", "-"]) await after(name, () => key(name));
  const point = (kind, x, y) => canvas.dispatchEvent(new PointerEvent(kind, { clientX: x, clientY: y }));
  canvas.setPointerCapture = () => {};
  await after("drag", () => (point("pointerdown", 300, 300), point("pointermove", 360, 320)));
  point("pointerup", 360, 320);
  await after("double click", () => canvas.dispatchEvent(new MouseEvent("dblclick")));
  return seen;
})()"""
PICTURES = "[...document.images].filter((one) => !one.complete || !one.naturalWidth).length"


@pytest.mark.slow(sanitized=True)
@needs_chromium
def test_every_control_works_under_the_policy(browser, page, tmp_path):
    """Of the page of an optimization, with a drawing that has a style of its own, as matplotlib writes it."""
    policy = re.search(r'http-equiv="Content-Security-Policy" content="([^"]*)"', page.read_text())[1]
    assert policy.startswith("default-src 'none'; img-src data:; style-src 'sha256-")
    assert "unsafe" not in policy
    browser.messages.clear()
    browser.requests.clear()
    browser.open(page)
    assert browser.run("document.documentElement.dataset.scene") == "ready"
    assert browser.run("getComputedStyle(document.body).maxWidth") == "992px"  # the style is taken
    assert browser.run(USED) == []
    assert browser.messages == []
    assert {one.split(":")[0] for one in browser.requests} <= {"file", "data"}
    assert [one for one in browser.requests if one.startswith("file")] == [page.as_uri()]


@pytest.mark.slow(sanitized=True)
@needs_chromium
def test_a_hostile_page_runs_and_asks_for_nothing(browser, folder, tmp_path):
    """Of a run whose folder, figures, command, versions and date a stranger named; the policy alone stops it too."""
    words = " ".join(text for text in HOSTILE if "\ud800" not in text)
    place = tmp_path / '"><img src=x onerror=window.ran=1><'
    shutil.copytree(folder, place)
    svg = "<svg xmlns='http://www.w3.org/2000/svg' width='9' height='9'><style>rect{fill:red}</style>"
    svg += "<script>top.ran=1</script><image href='http://127.0.0.1:9/a.png'/><rect width='9' height='9'/></svg>"
    for name in ("mechanism", "<script>window.ran=1<"):
        (place / f"{name}.svg").write_text(svg)
    (place / "mechanism.png").unlink()
    record = entries_of(place / "record.json")
    record |= {"command": words, "created": words, "versions": {text: text for text in HOSTILE}}
    record["results"]["optimization"] |= {"reason": words, "agreement": words}
    write_sealed(place / "record.json", record)
    page = nd.report(place)
    browser.messages.clear()
    browser.requests.clear()
    browser.open(page)
    assert browser.run("document.documentElement.dataset.scene") == "ready"
    assert browser.run("[typeof window.ran, document.scripts.length, document.querySelectorAll('base').length]") == [
        "undefined",
        2,
        0,
    ]
    assert SHOWN in browser.run("document.body.innerText")
    assert browser.run(PICTURES) == 0
    assert [one for one in browser.requests if not one.startswith(("data:", page.as_uri()))] == []
    assert browser.messages == []
    text = page.read_text()
    held = tmp_path / "held.html"  # as if something had not been escaped
    held.write_text(text.replace("</main>", "<script>window.ran=1</script><img src=x onerror=window.ran=1></main>"))
    browser.open(held)
    assert browser.run("typeof window.ran") == "undefined"
    assert len(browser.messages) >= 2

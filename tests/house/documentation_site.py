#!/usr/bin/python3
"""The documentation site is whole: its pages, what the search finds, and that nothing comes from elsewhere.

Usage: documentation_site.py ROOT BUILD_FOLDER CMAKE
"""
import html.parser
import importlib.util
import pathlib
import re
import shutil
import subprocess
import sys
import urllib.parse

PACKAGES = ("breathe", "furo", "myst_parser", "sphinx")
# A search for the words must find the page.
SEARCHES = (("shape derivatives", "docs/theory"), ("Windkessel", "xml/PARAMETERS"), ("PSPG", "docs/theory"),
            ("backflow stabilisation", "xml/PARAMETERS"))
CLASSES = ("tunica::run::Simulation", "tunica::materials::HyperelasticLaw")


class Page(html.parser.HTMLParser):
    """The names of a page, where its links lead, and what it loads."""

    def __init__(self, path):
        super().__init__()
        self.names, self.links, self.loads = {""}, set(), set()
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attrs):
        given = dict(attrs)
        self.names.add(given.get("id", ""))
        self.links.add(given.get("href", "") if tag == "a" else "")
        self.loads.add(given.get("src", ""))
        if tag == "link":
            self.loads.add(given.get("href", ""))


def wrong_links(site):
    pages = {path: Page(path) for path in site.rglob("*.html")}
    for path, page in pages.items():
        yield from (f"{path}: loads {url}" for url in page.loads if re.match(r"[a-z]+:|/", url) and url[:5] != "data:")
        for url in page.links | page.loads:
            if not re.match(r"[a-z]+:", url):
                parts = urllib.parse.urlsplit(url)
                target = (path.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else path
                if not target.exists():
                    yield f"{path}: {url} does not exist"
                elif target in pages and parts.fragment not in pages[target].names:
                    yield f"{path}: {url} has no such name"
    for style in site.rglob("*.css"):
        found = re.findall(r"url\(\s*[\"']?((?:https?:|/)[^)\"']*)", style.read_text(encoding="utf-8"))
        yield from (f"{style}: loads {url}" for url in found)


def missing_pages(root, site):
    shown = ["README.md", "CONTRIBUTING.md", "CHANGELOG.md", "xml/PARAMETERS.md", "src/REFERENCES.md"]
    shown += [str(path.relative_to(root)) for path in (*root.glob("docs/*.md"), *root.glob("bench/**/RESULTS.md"),
                                                        *root.glob("xml/**/RESULTS.md"))]
    return [f"{name} is not on the site" for name in shown if not (site / name).with_suffix(".html").exists()]


def failed_searches(site):
    from sphinx.search import js_index  # not everywhere, see main()
    from sphinx.search.en import SearchEnglish
    index = js_index.loads((site / "searchindex.js").read_text(encoding="utf-8"))
    stem = SearchEnglish({}).stem
    for words, page in SEARCHES:
        for word in words.lower().split():
            found = [index[key].get(stem(word), []) for key in ("terms", "titleterms")]
            found = {number for entry in found for number in (entry if isinstance(entry, list) else [entry])}
            if page not in {index["docnames"][number] for number in found}:
                yield f'a search for "{word}" does not find {page}'
    objects = {entry[-1] for entry in index["objects"][""]}
    yield from (f"a search does not find {name}" for name in CLASSES if name not in objects)


def main(root, build, cmake):
    if not shutil.which("doxygen") or not all(map(importlib.util.find_spec, PACKAGES)):
        print("skipped: the packages of cmake/apt-packages-site.txt are not all installed")
        return 77
    if subprocess.run([cmake, "--build", str(build), "--target", "site"], check=False).returncode != 0:
        return 1
    site = build / "site/html"
    problems = [*missing_pages(root, site), *failed_searches(site), *wrong_links(site)]
    print("\n".join(problems[:50] + [f"{len(problems)} problem(s)"]))
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve(), sys.argv[3]))

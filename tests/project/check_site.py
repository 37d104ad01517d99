#!/usr/bin/python3
"""check_site.py SOURCE_FOLDER SCRATCH: the site builds strictly, and every link, anchor and file of its pages exists.

Pages may link to other sites. They may not load anything from them.
"""
import shutil
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

source, scratch = (Path(word).resolve() for word in sys.argv[1:3])
LOADED = {("img", "src"), ("script", "src"), ("link", "href"), ("source", "src"), ("iframe", "src")}
NO_FILE = {"canonical", "preconnect"}  # kinds of <link> that load nothing
DOXYGEN = "cpp/"  # `make site` adds these pages
LEAST_PAGES = 25  # fewer mean that the navigation is broken


class Page(HTMLParser):
    def __init__(self, path):
        super().__init__()
        self.anchors, self.links = set(), []
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.anchors.update(values[key] for key in ("id", "name") if values.get(key))
        if tag == "link" and values.get("rel") in NO_FILE:
            return
        self.links += [(tag, key, values[key]) for key in ("href", "src") if values.get(key)]


def faults_of(site):
    pages = {path: Page(path) for path in site.rglob("*.html")}
    if len(pages) < LEAST_PAGES:
        yield f"only {len(pages)} pages"
    for path, page in pages.items():
        name = path.relative_to(site)
        for tag, key, link in page.links:
            parts = urlsplit(link)
            if parts.scheme or parts.netloc:
                if (tag, key) in LOADED and parts.scheme != "data":
                    yield f"{name} loads {link}"
                continue
            target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            target = target / "index.html" if target.is_dir() else target
            if name.name == "404.html" or target.is_relative_to(site) and target.relative_to(site).as_posix().startswith(DOXYGEN):
                continue
            if not target.exists():
                yield f"{name} links to {link}, which does not exist"
            elif parts.fragment and target in pages and unquote(parts.fragment) not in pages[target].anchors and parts.fragment != "__skip":
                yield f"{name} links to {link}: no such anchor"


def main():
    shutil.rmtree(scratch, ignore_errors=True)
    done = subprocess.run(["mkdocs", "build", "--strict", "--quiet", "--site-dir", scratch], cwd=source, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    faults = list(faults_of(scratch)) if not done.returncode else [done.stdout]
    count = len(list(scratch.rglob("*.html")))
    print("\n".join(faults) or f"{count} pages, all links lead somewhere")
    return 1 if faults else 0


sys.exit(main())

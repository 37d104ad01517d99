"""Hooks of MkDocs for the site: links that leave docs/, and the files of KaTeX."""
import os
import re
import shutil
from pathlib import Path

LINK = re.compile(r"(!?)\[((?:[^\[\]]|\[[^\]]*\])*)\]\(([^)\s]+)\)")
FENCE = re.compile(r"(^```.*?^```)", re.MULTILINE | re.DOTALL)
SOURCE = Path(__file__).resolve().parents[2]
pictures = set()  # outside docs/, in the pages
KATEX = Path("/usr/share/javascript/katex")  # of the package libjs-katex


def on_page_markdown(markdown, page, config, files):
    """Replaces links to files outside docs/ by their text and the path in the repository. Pictures from there are copied."""
    folder = os.path.dirname(page.file.src_path)

    def plain(match):
        image, text, target = match.groups()
        path = os.path.normpath(os.path.join(folder, target.partition("#")[0]))
        if re.match(r"[a-z]+:|#", target) or not path.startswith(".."):
            return match[0]
        path = re.sub(r"^(\.\./)+", "", path)
        if image:
            pictures.add(path)
            return f'<img alt="{text}" src="{"../" * page.file.src_path.count("/")}{path}">'
        return text if path in text else f"{text} (`{path}`)"

    parts = FENCE.split(markdown)
    return "".join(part if part.startswith("```") else LINK.sub(plain, part) for part in parts)


def on_post_build(config):
    """Copies KaTeX and its fonts into the site, as files and not as links. Removes the scripts that draw pictures."""
    site = Path(config["site_dir"])
    for script in [*site.rglob("*.py"), site / "site/Doxyfile"]:
        script.unlink()
    for picture in pictures:
        (site / picture).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(SOURCE / picture, site / picture)
    folder = site / "katex"
    for name in ("katex.min.css", "katex.min.js", "contrib/auto-render.js"):
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(KATEX / name, folder / name)
    shutil.copytree(KATEX / "fonts", folder / "fonts", dirs_exist_ok=True)

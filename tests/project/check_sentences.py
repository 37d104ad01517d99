#!/usr/bin/python3
"""check_sentences.py SOURCE_FOLDER [--all]: measures the sentences of README.md and docs.

No page may exceed a mean of 20 words per sentence, and no sentence 30 words. Pages of BACKLOG are older than this rule:
they have at most as many longer sentences as it says. --all prints each of them.
"""
import re
import sys
from pathlib import Path

MEAN, LONGEST = 20, 30  # words
ENOUGH = 10  # sentences, below which a mean says little
# Longer sentences that a page still has. These numbers may only fall.
BACKLOG = {
    "docs/reference/design.md": 1,
    "docs/reference/sections.md": 2,
    "docs/reference/target-curve.md": 1,
    "docs/reference/target-display.md": 1,
    "docs/reference/target-fold.md": 2,
    "docs/reference/target-space-curve.md": 1,
}
WORD = re.compile(r"[^\W\d_][\w'’-]*")


def blocks_of(text):
    """Yields paragraphs, list items, and the parts of table cells between semicolons, without code, links and formulas."""
    text = re.sub(r"^```.*?^```$", "", text, flags=re.MULTILINE | re.DOTALL)
    text = re.sub(r"<!--.*?-->", "", text, flags=re.DOTALL)
    text = re.sub(r"!\[[^\]]*\]\([^)]*\)", "", text)
    text = re.sub(r"\[([^\[\]]*)\]\([^)]*\)", r"\1", text)
    text = re.sub(r"`[^`]*`", "x", text)
    block = ""
    for line in text.splitlines() + [""]:
        starts_anew = not line.strip() or re.match(r"\s*([-*+]|\d+\.)\s|#|\||:::|    \w", line)
        if starts_anew and block:
            yield block
            block = ""
        if line.startswith("|"):
            yield from (part for cell in line.strip().strip("|").split("|") for part in cell.split(";") if re.search(r"\w", part))
        elif line.strip() and not line.startswith(("#", ":::")):
            block += " " + re.sub(r"^\s*([-*+]|\d+\.)\s+", "", line.strip())


def sentences_of(text):
    for block in blocks_of(text):
        for sentence in re.split(r"(?<=[.!?:;])(?:\*\*|[*_)])*\s+(?=[A-Z*\[(0-9x]|kinetix|\w+\.(?:txt|json|yaml|html))", block):
            words = WORD.findall(re.sub(r"<[^>]*>", "", sentence))
            if words:
                yield len(words), " ".join(sentence.split())


def measure(text):
    """Returns the number of whole sentences, their mean length, and the sentences that are too long."""
    found = list(sentences_of(text))
    whole = [count for count, sentence in found if sentence.rstrip("*_)")[-1:] in ".!?"]
    return len(whole), sum(whole) / max(1, len(whole)), [(n, sentence) for n, sentence in found if n > LONGEST]


def main():
    root, prints_all = Path(sys.argv[1]), "--all" in sys.argv[2:]
    if measure("word " * 31 + ".\n\n- one\n- two\n")[2][0][0] != 31:
        print("the pattern does not find a long sentence")
        return 1
    faults, means = [], []
    for path in [root / "README.md", *sorted(root.glob("docs/**/*.md"))]:
        name = path.relative_to(root).as_posix()
        count, mean, long_ones = measure(path.read_text(encoding="utf-8"))
        allowed = BACKLOG.get(name, 0)
        if len(long_ones) > allowed:
            faults.append(f"{name}: {len(long_ones)} sentences over {LONGEST} words, {allowed} allowed")
            faults += [f"  {words} words: {sentence}" for words, sentence in long_ones] if prints_all or not allowed else []
        if mean > MEAN and count >= ENOUGH:
            faults.append(f"{name}: {mean:.1f} words per sentence on average, at most {MEAN}")
        means.append((name, mean))
    print("\n".join(faults) or "\n".join(f"{mean:5.1f} words per sentence  {name}" for name, mean in means))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())

"""The pages that people read: their links, their length, their sentences.

    python3 pages_test.py ROOT

Links lead to files and headings that are there. The users' pages have short
sentences (ISO 24495-1 asks for plain language; the bounds are ours). READMEs
of folders keep to what a developer needs. With --list the sentences of each
page are counted, and nothing is judged.
"""

import os
import pathlib
import re
import sys

MOST_WORDS = 35  # of a sentence
MEAN_WORDS = 18  # of a page
CODE_COLUMNS = 76  # errmap help TOPIC indents it by four
README_LINES = 90
FOLDER_README_LINES = 80


def prose(text):
    """The paragraphs and items, without code, tables, headings, marks."""
    text = re.sub(r"<!--.*?-->", "", text, flags=re.S)
    text = re.sub(r"^```.*?^```", "", text, flags=re.S | re.M)
    text = re.sub(r"!\[[^\]]*\]\([^)]*\)", "", text)
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", text)
    # What stands in `code` is one word, whatever it holds.
    text = re.sub(r"`[^`]*`", "Code", text)
    blocks = []
    for line in text.splitlines() + [""]:
        if line.startswith(("#", "|")) or not line.strip():
            blocks.append("")
        elif line.lstrip().startswith(("- ", "* ")):
            blocks.append(line.lstrip()[2:])
        elif blocks and blocks[-1]:
            blocks[-1] += " " + line.strip()
        else:
            blocks.append(line.strip())
    return [block for block in blocks if block]


def sentences(text):
    found = []
    for block in prose(text):
        for part in re.split(r"(?<=[.!?])[\"”)]*\s+(?=[A-Z\d\"(\[*]|errmap)", block):
            words = re.findall(r"[\w'’./%+-]*\w[\w'’./%+-]*", part)
            if words:
                found.append((len(words), part))
    return found


def anchor(heading):
    """As GitHub and cmark-gfm's readers make it of a heading."""
    heading = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading)
    heading = heading.replace("`", "").strip().lower()
    return re.sub(r"[^\w\- ]", "", heading).replace(" ", "-")


def anchors(page):
    text = re.sub(r"^```.*?^```", "", page.read_text(), flags=re.S | re.M)
    return {anchor(h) for h in re.findall(r"^#+ +(.*)$", text, flags=re.M)}


def check_links(root, page, problems):
    text = re.sub(r"^```.*?^```", "", page.read_text(), flags=re.S | re.M)
    text = re.sub(r"`[^`\n]*`", "", text)
    for link in re.findall(r"\]\(([^)\s]+)\)", text):
        if re.match(r"[a-z]+:", link):
            continue
        path, _, part = link.partition("#")
        target = (page.parent / path).resolve() if path else page
        if not target.exists():
            problems.append(f"{page.relative_to(root)}: no {link}")
        elif part and part not in anchors(target):
            problems.append(f"{page.relative_to(root)}: no heading #{part}")


def check_sentences(root, page, problems, listed):
    counted = sentences(page.read_text())
    if not counted:
        return
    mean = sum(n for n, _ in counted) / len(counted)
    longest = max(counted)
    name = page.relative_to(root)
    if listed:
        print(f"{name}: {len(counted)} sentences, mean {mean:.1f} words, "
              f"longest {longest[0]}")
        return
    if mean > MEAN_WORDS:
        problems.append(f"{name}: sentences of {mean:.1f} words in the mean, "
                        f"more than {MEAN_WORDS}")
    for count, sentence in counted:
        if count > MOST_WORDS:
            problems.append(f"{name}: a sentence of {count} words: "
                            f"{sentence[:70]}...")


# What looks like a name of ours and is an example, or of another program.
FOREIGN = {"report.md", "data/nist/", "kVerdictX", "XInVerdict"}


def check_names(root, pages, files, problems):
    """Files, folders and types that folders' READMEs name are there."""
    known = {f.rsplit("/", 1)[-1] for f in files}
    folders = {f"{p}/" for f in files for p in pathlib.PurePath(f).parents}
    words = set()
    for file in files:
        if re.search(r"\.(h|cc|in|cmake|py|sh|txt|toml)$", file) and \
                not file.startswith("data/sets/") and (root / file).exists():
            words.update(re.findall(r"\w+", (root / file).read_text()))
    found = 0
    for page in pages:
        text = re.sub(r"^```.*?^```", "", page.read_text(), flags=re.S | re.M)
        for name in sorted(set(re.findall(r"`([^`\n]+)`", text)) - FOREIGN):
            if re.search(r"NAME|ROOM|\.\.\.", name):
                continue
            if re.fullmatch(r"[\w/.-]+\.(h|cc|py|sh|patch|md)", name):
                there = name.rsplit("/", 1)[-1] in known
            elif re.fullmatch(r"[\w/.-]+/", name):
                there = any(("/" + f).endswith("/" + name) for f in folders)
            elif re.fullmatch(r"(\w+::)*[A-Z]\w*[a-z]\w*[A-Z]\w*(\(\))?|k[A-Z]\w+",
                              name):
                there = name.rstrip("()").split("::")[-1] in words
            else:
                continue
            found += 1
            if not there:
                problems.append(f"{page.relative_to(root)}: there is no {name}")
    if found < 100:
        problems.append(f"only {found} names of files and types were found")


def check_code(root, page, problems):
    """Commands and outputs of a page fit a terminal of 80 columns."""
    for block in re.findall(r"^```.*?^```", page.read_text(), flags=re.S | re.M):
        for line in block.splitlines():
            if len(line) > CODE_COLUMNS:
                problems.append(f"{page.relative_to(root)}: wider than "
                                f"{CODE_COLUMNS} columns: {line}")


def check_length(root, page, most, problems):
    lines = len(page.read_text().splitlines())
    if lines > most:
        problems.append(f"{page.relative_to(root)}: {lines} lines, more than "
                        f"{most}")


def check_myself():
    assert [n for n, _ in sentences("# A b\n\nOne two. Three `a b` four!\n"
                                    "- an item\n\n```sh\nno\n```\n| no |\n")] \
        == [2, 3, 2]
    assert sentences("See [the page](a.md). It errs 0.5 um at most.")[1][0] == 6
    assert anchor("What `errmap` says, and why") == "what-errmap-says-and-why"


def main(root, listed):
    check_myself()
    problems = []
    files = [str(p.relative_to(root)) for p in root.rglob("*") if p.is_file()
             and not p.relative_to(root).parts[0].startswith(("build", ".git"))]
    pages = sorted(root / f for f in files if f.endswith(".md"))
    listed_pages = (root / "cli/manual/pages.cmake").read_text()
    names = re.search(r"set\(manual_pages(.*?)\)", listed_pages,
                      flags=re.S).group(1).split()
    here = root / "cli/manual"
    manual = [p for p in pages if p.parent == here] + \
             [(here / f"{name}.md").resolve() for name in names if "/" in name]
    users = [root / "README.md", root / "data/sets/examples.md"] + manual
    for page in pages:
        check_links(root, page, problems)
        if page.name == "README.md" and page not in users:
            check_length(root, page, FOLDER_README_LINES, problems)
    check_names(root, [p for p in pages if p.name == "README.md" and
                       p not in users and "golden" not in p.parts],
                files, problems)
    check_length(root, root / "README.md", README_LINES, problems)
    for page in users:
        check_sentences(root, page, problems, listed)
    for page in manual:
        check_code(root, page, problems)
        name = os.path.relpath(page.with_suffix(""), here)
        if name != "README" and name not in names:
            problems.append(f"{page.name} is not in pages.cmake")
        if name != "README" and \
                f"]({name}.md)" not in (here / "README.md").read_text():
            problems.append(f"cli/manual/README.md does not lead to {page.name}")
    stories = re.findall(r"^## \d+\.",
                         (root / "data/sets/examples.md").read_text(),
                         flags=re.M)
    if len(stories) != 10:
        problems.append(f"data/sets/examples.md: {len(stories)} stories")
    words = (root / "cli/manual/words.md").read_text()
    pictures = re.findall(r"\(pictures/([\w-]+\.svg)\)", words)
    drawn = {p.name for p in (root / "cli/manual/pictures").glob("*.svg")}
    if set(pictures) != drawn or len(pictures) != 10:
        problems.append("words.md has not ten pictures, or others than "
                        "cli/manual/pictures")
    for problem in problems:
        print(problem, file=sys.stderr)
    print(f"{len(pages)} pages, {len(problems)} problems")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), "--list" in sys.argv[2:]))

#!/usr/bin/env python3
"""Puts the book together from book/, the documents and the program's own account of itself, and has mdBook make it.

    scripts/book.py --righting target/release/righting --mdbook target/mdbook/bin/mdbook --out out/book
"""

import argparse
import json
import re
import shutil
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
# Documents that are pages of the book where they stand.
DOCUMENTS = ["README.md", "CONTRIBUTING.md", "ARCHITECTURE.md", "CHANGELOG.md", "python/README.md", "docs/*"]
SCHEMAS = {
    "scenario": "Scenario files",
    "system": "System files",
    "sweep": "Sweep files",
    "wheels": "Files of wheels",
    "solution": "solution.json",
}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--righting", type=Path, required=True)
    parser.add_argument("--mdbook", type=Path, required=True)
    parser.add_argument("--out", type=Path, required=True)
    arguments = parser.parse_args()
    work = arguments.out.resolve() / "work"
    shutil.rmtree(work, ignore_errors=True)
    shutil.copytree(ROOT / "book", work)
    pages = work / "src"
    for pattern in DOCUMENTS:
        for document in sorted(ROOT.glob(pattern)):
            target = pages / document.relative_to(ROOT)
            target.parent.mkdir(exist_ok=True)
            shutil.copy(document, target)
    write_reference(arguments.righting.resolve(), pages / "reference")
    for page in pages.rglob("*.md"):
        text = with_sections(page.read_text())
        page.write_text(without_links_out(text, page, pages))
    html = arguments.out.resolve() / "html"
    subprocess.run([arguments.mdbook.resolve(), "build", work, "--dest-dir", html], check=True)
    shutil.rmtree(work)
    refuse_the_network(html)
    print(html / "index.html")


def write_reference(righting: Path, folder: Path) -> None:
    subprocess.run([righting, "manpages", folder, "--markdown"], check=True, stdout=subprocess.DEVNULL)
    for file, title in SCHEMAS.items():
        printed = subprocess.run([righting, "schema", file], check=True, capture_output=True, text=True).stdout
        (folder / f"{file}.md").write_text(schema_page(title, file, json.loads(printed)))


def schema_page(title: str, file: str, schema: dict) -> str:
    """One table for the file itself and one for every object in it."""
    parts = [f"# {title}\n\nFrom `righting schema {file}`, which prints the JSON Schema.\n"]
    for name, part in {title: schema, **schema.get("$defs", {})}.items():
        heading = "" if part is schema else f"\n## {name}\n"
        parts.append(f"{heading}\n{about(part)}\n")
        for object_ in [part, *part.get("oneOf", []), *part.get("anyOf", [])]:
            if "properties" in object_:
                parts.append(fields(object_))
            elif "const" in object_ or "enum" in object_:
                values = object_.get("enum", [object_.get("const")])
                parts.append("\n" + ", ".join(f"`{json.dumps(value)}`" for value in values) + f": {about(object_)}\n")
    return "\n".join(parts)


def fields(object_: dict) -> str:
    rows = ["| field | type | meaning |", "| --- | --- | --- |"]
    required = object_.get("required", [])
    for name, field in object_["properties"].items():
        needed = " **needed**" if name in required else ""
        rows.append(f"| `{name}`{needed} | {type_of(field)} | {about(field)} |")
    return "\n".join(rows) + "\n"


def about(schema: dict | bool) -> str:
    return cell(schema.get("description", "")) if isinstance(schema, dict) else ""


def type_of(field: dict | bool) -> str:
    if not isinstance(field, dict):
        return "anything"
    if "$ref" in field:
        name = field["$ref"].rsplit("/", 1)[-1]
        return f"[{name}](#{name.lower()})"
    if "const" in field:
        return f"`{json.dumps(field['const'])}`"
    if "enum" in field:
        return ", ".join(f"`{json.dumps(value)}`" for value in field["enum"])
    for choice in ("anyOf", "oneOf", "allOf"):
        if choice in field:
            return " or ".join(type_of(part) for part in field[choice] if part.get("type") != "null")
    kinds = field.get("type", "anything")
    kinds = [kind for kind in ([kinds] if isinstance(kinds, str) else kinds) if kind != "null"]
    of = f" of {type_of(field['items'])}" if isinstance(field.get("items"), dict) else ""
    return " or ".join(kinds) + of


def cell(text: str) -> str:
    """Text that is one cell of a table, and no element of HTML."""
    return re.sub(r"\s+", " ", text).replace("|", "\\|").replace("<", "&lt;")


def with_sections(text: str) -> str:
    """Puts in the sections of documents that a page names: `{{section README.md Limitations}}`."""

    def section(match: re.Match) -> str:
        document = (ROOT / match[1]).read_text()
        found = re.search(rf"^## {re.escape(match[2])}\n(.*?)(?=^## |\Z)", document, re.MULTILINE | re.DOTALL)
        if not found:
            raise SystemExit(f"{match[1]} has no section {match[2]}")
        return f"# {match[2]}\n{found[1].rstrip()}"

    return re.sub(r"\{\{section (\S+) (.+?)\}\}", section, text)


def without_links_out(text: str, page: Path, pages: Path) -> str:
    """Keeps links to pages and pictures of the book; of the others, which are files of the project, only the text."""

    def link(match: re.Match) -> str:
        target = match[2].split("#")[0]
        is_kept = "://" in target or target == "" or (page.parent / target).exists()
        return match[0] if is_kept else match[1]

    return re.sub(r"\[([^\]]*)\]\(([^)\s]+)\)", link, text)


def refuse_the_network(html: Path) -> None:
    """No page may load anything from elsewhere; links to follow are none of that."""
    loads = re.compile(r"<(?:script|img|link|iframe)\b[^>]*\b(?:src|href)=\"(?:https?:)?//[^\"]*\"")
    for page in html.rglob("*.html"):
        found = loads.search(page.read_text())
        if found:
            raise SystemExit(f"{page} loads {found[0]}")


if __name__ == "__main__":
    main()

"""The documents as a site: python docs/build_site.py [FOLDER]; needs the extra docs.

The pages are those of the repository, which stay plain Markdown. They are gathered in a folder of
the same layout, so that links between them hold; what a page links to beside pages (tests,
examples) goes along. The contents on the left, and the pages of the API, are made here.
"""

import re
import shutil
import sys
from pathlib import Path

import antinode

sys.path.insert(0, str(Path(__file__).resolve().parent))
from run_notebooks import as_page, notebooks

ROOT = Path(__file__).resolve().parents[1]
DEFAULT = ROOT / "build" / "site"
LINK = re.compile(r"\]\(([^)\s#]+)(#[^)\s]*)?\)")

CONTENTS = {
    "Start": ("../README", "tutorial", "gallery", "notebooks/*"),
    "How to": ("howto", "howto/*"),
    "Know": ("conventions", "glossary", "theory/*"),
    "Trust": ("validation", "../validation/*", "paper", "../benchmarks/*"),
    "API": ("../api/index",),
    "Change": ("architecture", "adr/*", "releasing", "../CONTRIBUTING", "../CHANGELOG"),
}
"""Captions of the contents on the left, and pages from docs/; a star stands for all others."""

WHOLE = ("The solver", "From beam to result", "The vehicle")
MORE = {
    "errors.py",
    "inputs/units.py",
    "vehicle/statics.py",
    "show/tables.py",
    "show/writing.py",
    "show/loads_table.py",
    "show/style.py",
    "show/figures.py",
    "modes/verify.py",
    "vehicle/derivatives.py",
    "study/eigenvalues.py",
    "report/command.py",
}
"""Parts of the architecture whose modules all have a page, and modules besides that have one."""


def pages() -> list[Path]:
    """Return the Markdown files of the site, from the root of the repository."""
    folders = ("docs", "benchmarks", "validation")
    found = [path for name in folders for path in (ROOT / name).rglob("*.md")]
    return sorted(path.relative_to(ROOT) for path in [*ROOT.glob("*.md"), *found])


def gather(folder: Path) -> None:
    """Copy pages and what they link to into a folder of the same layout."""
    for page in pages():
        copy(page, folder)
        for target, _ in LINK.findall((ROOT / page).read_text(encoding="utf-8")):
            file = (ROOT / page).parent / target
            if not re.match(r"[a-z]+:", target) and file.is_file():
                copy(file.resolve().relative_to(ROOT), folder)
    (folder / "docs" / "notebooks").mkdir(parents=True, exist_ok=True)
    for notebook in notebooks():
        as_page(notebook, folder / "docs" / "notebooks")
    add_contents(folder)


def copy(file: Path, folder: Path) -> None:
    """Copy a file of the repository to its place in the folder."""
    (folder / file).parent.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(ROOT / file, folder / file)


def add_contents(folder: Path) -> None:
    """Append the contents, which no reader of the plain file needs, to the index."""
    trees, seen = [], {"docs/index"}
    for caption, patterns in CONTENTS.items():
        entries = [e for pattern in patterns for e in expand(folder, pattern) if e not in seen]
        seen.update(entries)
        lines = "\n".join(f"/{entry}" for entry in dict.fromkeys(entries))
        trees.append(f"```{{toctree}}\n:hidden:\n:caption: {caption}\n\n{lines}\n```\n")
    with (folder / "docs" / "index.md").open("a", encoding="utf-8") as file:
        file.write("\n" + "\n".join(trees))


def expand(folder: Path, pattern: str) -> list[str]:
    """Return the pages of a pattern, from the top of the folder and without endings."""
    if "*" not in pattern:
        return [(Path("docs") / pattern).as_posix().replace("docs/../", "")]
    found = sorted((folder / "docs").resolve().glob(pattern.removeprefix("../") + ".md"))
    if pattern.startswith("../"):
        found = sorted(folder.glob(pattern.removeprefix("../") + ".md"))
    return [path.relative_to(folder).with_suffix("").as_posix() for path in found]


def write_api(folder: Path) -> None:
    """Write a page for every module, with what its docstrings say, and an overview."""
    (folder / "api").mkdir(parents=True, exist_ok=True)
    modules = documented()
    for name in modules:
        title = name.removeprefix("antinode.")
        text = f"{title}\n{'=' * len(title)}\n\n.. automodule:: {name}\n"
        (folder / "api" / f"{name}.rst").write_text(text, encoding="utf-8")
    (folder / "api" / "index.rst").write_text(overview(modules), encoding="utf-8")


def documented() -> list[str]:
    """Return the modules that make an interface, in the order of the architecture page."""
    text = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
    names = (home.partition(":")[0] for home in antinode._HOME.values())
    homes = {f"{name.replace('.', '/')}.py" for name in names} | MORE
    found = []
    for part in re.split(r"^## ", text, flags=re.MULTILINE):
        files = re.findall(r"^\| `([\w/]+\.py)`", part, re.MULTILINE)
        whole = part.partition("\n")[0] in WHOLE
        found += [file for file in files if whole or file in homes]
    return ["antinode." + file.removesuffix(".py").replace("/", ".") for file in found]


def overview(modules: list[str]) -> str:
    """Return the page that lists the names of `import antinode`, and all modules."""
    lines = ["API", "===", "", "``import antinode as an`` gives:", ""]
    lines += [".. list-table::", "   :widths: 30 70", ""]
    for name in sorted(antinode.__all__, key=str.lower):
        item = getattr(antinode, name)
        if name.startswith("__"):
            continue
        first = (item.__doc__ or "").strip().splitlines()[0]
        lines += [
            f"   * - :py:obj:`an.{name} <{item.__module__}.{item.__name__}>`",
            f"     - {first}",
        ]
    lines += ["", "Modules, from the ground up:", "", ".. toctree::", "   :maxdepth: 1", ""]
    return "\n".join([*lines, *(f"   {name}" for name in modules), ""])


def build(target: Path) -> int:
    """Build the site; every warning is an error. Return the exit code of Sphinx."""
    from sphinx.cmd.build import main as sphinx

    source = target.with_name(target.name + "-source")
    for folder in (source, target):
        shutil.rmtree(folder, ignore_errors=True)
    gather(source)
    write_api(source)
    options = ["-q", "-W", "--keep-going", "-j", "auto", "-b", "html", "-c", str(ROOT / "docs")]
    code = int(sphinx([*options, str(source), str(target)]))
    front = '<!DOCTYPE html><meta charset="utf-8"><title>antinode</title>'
    front += '<meta http-equiv="refresh" content="0; url=docs/index.html">'
    (target / "index.html").write_text(front, encoding="utf-8")
    return code


if __name__ == "__main__":
    sys.exit(build(Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else DEFAULT))

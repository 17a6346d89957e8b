"""The documents tell the truth: their commands run, their output is real, their links lead on.

In every Markdown file that has blocks to run, in order and in one temporary folder:

- a block ```toml or ```csv whose first line is a comment with a file name is written to that file;
- a block ```sh run is run by bash with the installed `antinode` on the path; but for the README and
  the tutorial, one that holds nothing but calls of `antinode` is run by this process;
- a block ```python run is executed; the blocks of a document share their variables;
- a block ```text right after one that ran shows its output, perhaps shortened by lines of "...".
  Its words must be there in the same order, line breaks and table rules aside. A number may differ
  by one unit of its last digit; one like 3.1e-09 is an error and may be up to 100 times as large.
- a comment <!-- run: COMMAND --> is a command that the reader does not need to see.
"""

import ast
import io
import os
import re
import shlex
import subprocess
import sys
from contextlib import redirect_stdout
from dataclasses import dataclass
from pathlib import Path

import pytest

from cli_run import run

ROOT = Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
SOURCE = ROOT / "src" / "antinode"
TYPED = ("README.md", "docs/tutorial.md")
"""Documents whose commands are run as a reader types them, each in a process of its own."""


def markdown_files():
    """Every Markdown file of the project, from the root of the repository."""
    hidden = {path for path in ROOT.iterdir() if path.name.startswith(".")}
    found = [*ROOT.glob("*.md")]
    for folder in ROOT.iterdir():
        if folder.is_dir() and folder not in hidden:
            found += folder.rglob("*.md")
    return sorted(str(path.relative_to(ROOT)) for path in found if "node_modules" not in path.parts)


def documents_that_run():
    """Markdown files with a block to run."""
    mark = re.compile(r"^(```\w+ run$|<!-- run: )", re.MULTILINE)
    return [name for name in markdown_files() if mark.search((ROOT / name).read_text("utf-8"))]


# --- blocks that run -------------------------------------------------------------------------


@dataclass
class Block:
    """A fenced block: language, the other words of its first line, text, line in the file."""

    language: str
    words: list
    text: str
    line: int


def blocks(text):
    """Fenced blocks and hidden commands of a Markdown text, in order."""
    found, lines, start = [], text.splitlines(), None
    for number, line in enumerate(lines, 1):
        if start is None and (hidden := re.fullmatch(r"<!-- run: (.*) -->", line)):
            found.append(Block("sh", ["run"], hidden[1], number))
        elif line.startswith("```"):
            if start is None:
                start = number
            else:
                language, *words = lines[start - 1][3:].split() or [""]
                body = "\n".join(lines[start : number - 1])
                found.append(Block(language, words, body, start))
                start = None
    return found


def run_shell(text):
    """Run commands; return what they print."""
    path = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
    done = subprocess.run(
        ["bash", "-euo", "pipefail", "-c", text],
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, "PATH": path},
    )
    return said(done.returncode, done.stdout + done.stderr)


def said(code, text):
    """Return what commands printed, which must have gone well."""
    assert not code, f"exit code {code}:\n{text}"
    return text


def calls(text):
    """Return the arguments of every call in a block of calls of antinode; None of any other."""
    if re.search(r"[|<>$;&*`#()]", text):
        return None
    lines = [shlex.split(line) for line in text.replace("\\\n", " ").splitlines() if line.strip()]
    return [line[1:] for line in lines] if all(line[0] == "antinode" for line in lines) else None


def run_here(arguments):
    """Run antinode in this process; return what it prints."""
    code, out, err = run(*arguments)
    return said(code, out + err)


def run_python(text, names, where):
    """Execute a snippet; return what it prints."""
    out = io.StringIO()
    with redirect_stdout(out):
        exec(compile(text, where, "exec"), names)
    return out.getvalue()


@pytest.mark.parametrize("document", documents_that_run())
def test_commands_and_snippets(document, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MPLBACKEND", "Agg")
    monkeypatch.setenv("COLUMNS", "104")
    names, printed, shown = {"__name__": document}, None, 0
    for block in blocks((ROOT / document).read_text(encoding="utf-8")):
        where = f"{document}:{block.line}"
        runs, output = "run" in block.words, None
        if block.language in ("toml", "csv"):
            write_file(block.text)
        elif block.language == "sh" and runs:
            here = None if document in TYPED else calls(block.text)
            output = run_shell(block.text) if here is None else "".join(map(run_here, here))
        elif block.language == "python" and runs:
            output = run_python(block.text, names, where)
        elif block.language == "text" and printed is not None:
            assert_shown(block.text, printed, where)
            shown += 1
        printed = output
    assert shown > 0


def write_file(text):
    """Write a block to the file that its first line names."""
    name = re.match(r"# (\S+\.\w+)\b", text)
    if name:
        Path(name[1]).write_text(text + "\n", encoding="utf-8")


# --- shown output against the real one -------------------------------------------------------


def tokens(text):
    """Words and numbers, without the rules of tables."""
    return [word for word in text.split() if set(word) - set("─━-")]


def assert_shown(shown, printed, where):
    """Every piece between lines of "..." stands in what was printed, in the same order."""
    real, position = tokens(printed), 0
    for piece in re.split(r"^\s*\.\.\.\s*$", shown, flags=re.MULTILINE):
        wanted = tokens(piece)
        ends = [
            start + len(wanted)
            for start in range(position, len(real) - len(wanted) + 1)
            if all(map(same, wanted, real[start : start + len(wanted)]))
        ]
        if not ends:
            raise AssertionError(f"{where} shows\n{piece}\nbut what is printed is\n{printed}")
        position = ends[0]


def same(shown, real):
    """Whether two tokens agree: as words, or as numbers to the last digit shown."""
    a, b = number(shown), number(real)
    if a is None or b is None or shown == real:
        return shown == real
    if "e-" in shown:
        return abs(b) <= 100 * abs(a)
    return abs(a - b) <= 1.01 * max(last_digit(shown), last_digit(real))


def number(token):
    """The number in a token such as '(3.25,' or None."""
    try:
        return float(token.strip("()[],;:%"))
    except ValueError:
        return None


def last_digit(token):
    """Value of one unit of the last digit of a number."""
    mantissa, _, exponent = token.strip("()[],;:%").lower().partition("e")
    return 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))


def test_the_comparison_itself():
    printed = "a  b\n 1.2340 c\n──────\n kept 7e-09"
    assert_shown("a b\n...\n1.2341 c\nkept 3e-09", printed, "here")
    for wrong in ("a 1.2340", "1.2342 c", "c\n...\na", "kept 3e-12"):
        with pytest.raises(AssertionError):
            assert_shown(wrong, printed, "here")


# --- links -----------------------------------------------------------------------------------


def prose(text):
    """Return a Markdown text without its code."""
    return re.sub(r"`[^`]*`", "", re.sub(r"^```.*?^```", "", text, flags=re.MULTILINE | re.DOTALL))


def anchors(path):
    """Anchors of the headings of a Markdown file."""
    text = re.sub(r"^```.*?^```", "", path.read_text(encoding="utf-8"), flags=re.M | re.S)
    titles = re.findall(r"^#+ (.*)$", text, flags=re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", title).strip().lower().replace(" ", "-") for title in titles}


@pytest.mark.parametrize("document", markdown_files())
def test_links(document):
    path = ROOT / document
    for target in re.findall(r"\]\(([^)\s]+)\)", prose(path.read_text(encoding="utf-8"))):
        if re.match(r"[a-z]+:", target):
            continue
        name, _, anchor = target.partition("#")
        file = (path.parent / name).resolve() if name else path
        assert file.exists(), f"{document}: {target} leads nowhere"
        if anchor:
            assert anchor in anchors(file), f"{document}: {target} has no such heading"


def test_the_index_leads_to_every_document():
    text = (DOCS / "index.md").read_text(encoding="utf-8")
    for document in DOCS.rglob("*.md"):
        name = document.relative_to(DOCS).as_posix()
        assert name == "index.md" or f"({name})" in text, f"docs/index.md does not name {name}"


# --- tables that must be complete ------------------------------------------------------------


def table_rows(text, columns):
    """Rows of the Markdown tables with that many columns, without heads and rules."""
    lines = [line for line in text.splitlines() if line.startswith("|")]
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]
    return [row for row in rows if len(row) == columns and set(row[0]) - set("-: ")]


def test_every_row_of_the_validation_table_has_its_test_and_every_test_folder_a_row():
    rows = table_rows((DOCS / "validation.md").read_text(encoding="utf-8"), 6)
    rows = [row for row in rows if row[0] != "case"]
    files = [re.findall(r"\]\(\.\./(tests/[^)]+)\)", row[-1]) for row in rows]
    for row, tests in zip(rows, files, strict=True):
        assert tests, f"the row '{row[0]}' names no test"
        for test in tests:
            assert (ROOT / test).is_file(), f"the row '{row[0]}' names {test}, which is missing"
    named = {Path(test).parts[1] for tests in files for test in tests}
    folders = {path.relative_to(ROOT).parts[1] for path in (ROOT / "tests").rglob("test_*.py")}
    assert folders <= named, f"no row for {folders - named}"


def listed_modules():
    """Modules in the order of docs/architecture.md."""
    text = (DOCS / "architecture.md").read_text(encoding="utf-8")
    return [name.removesuffix(".py") for name in re.findall(r"^\| `([\w/]+\.py)`", text, re.M)]


def imports(path):
    """Our own modules that a module imports when it is imported itself."""
    package = path.relative_to(SOURCE).parts[:-1]
    for node in ast.parse(path.read_text(encoding="utf-8")).body:
        if not isinstance(node, ast.ImportFrom):
            continue
        module = (node.module or "").split(".") if node.module else []
        if node.level:
            module = [*package[: len(package) - node.level + 1], *module]
        elif module[:1] == ["antinode"]:
            module = module[1:]
        else:
            continue
        for name in node.names:
            inner = SOURCE.joinpath(*module, f"{name.name}.py")
            yield "/".join([*module, name.name] if inner.exists() else module)


def test_the_architecture_lists_every_module_and_imports_run_one_way():
    listed = listed_modules()
    files = {p.relative_to(SOURCE).with_suffix("").as_posix() for p in SOURCE.rglob("*.py")}
    assert set(listed) == {name for name in files if not name.endswith("__init__")}
    for position, name in enumerate(listed):
        for other in imports(SOURCE / f"{name}.py"):
            if (SOURCE / f"{other}.py").exists():
                assert other in listed[:position], f"{name} imports {other}, which comes after it"


def test_the_solver_knows_no_vehicle():
    for path in (SOURCE / "riccati").rglob("*.py"):
        tree = ast.parse(path.read_text(encoding="utf-8"))
        for node in ast.walk(tree):
            if isinstance(node, ast.ImportFrom):
                module = node.module or ""
                ours = node.level > 1 or module.startswith("antinode")
                assert not ours or module.startswith("antinode.riccati"), (
                    f"{path.name} imports from outside riccati"
                )

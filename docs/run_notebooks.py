"""Notebooks of the documents: run in this process, and as pages of the site.

    python docs/run_notebooks.py        # runs all, and keeps what they show in their files

A cell is executed as Jupyter does: what it prints, then the value of its last expression (its
`_repr_html_` too), then every figure of matplotlib that it drew. No kernel is needed.
"""

import ast
import base64
import io
import json
import os
import sys
import tempfile
from contextlib import chdir, redirect_stdout
from pathlib import Path

FOLDER = Path(__file__).resolve().parent / "notebooks"


def notebooks() -> list[Path]:
    """Return all notebooks."""
    return sorted(FOLDER.glob("*.ipynb"))


def run(path: Path, folder: Path, *, figures: bool = True) -> list[list[dict]]:
    """Run a notebook in a folder; return the outputs of its code cells, in Jupyter's format."""
    names: dict = {"__name__": "__main__"}
    with chdir(folder):
        return [
            outputs_of("".join(cell["source"]), names, f"{path.name}, cell {k}", figures=figures)
            for k, cell in enumerate(read(path)["cells"], 1)
            if cell["cell_type"] == "code"
        ]


def read(path: Path) -> dict:
    """Return a notebook as its tables."""
    return json.loads(path.read_text(encoding="utf-8"))


def outputs_of(source: str, names: dict, where: str, *, figures: bool) -> list[dict]:
    """Execute a cell; return what it shows."""
    import matplotlib.pyplot as plt

    tree = ast.parse(source)
    last = ast.Expression(tree.body.pop().value) if isinstance(tree.body[-1], ast.Expr) else None
    printed, value = io.StringIO(), None
    with redirect_stdout(printed):
        exec(compile(tree, where, "exec"), names)
        if last is not None and not source.rstrip().endswith(";"):
            value = eval(compile(last, where, "eval"), names)
        elif last is not None:
            eval(compile(last, where, "eval"), names)
    shown = []
    if text := printed.getvalue():
        shown.append({"output_type": "stream", "name": "stdout", "text": lines_of(text)})
    if value is not None:
        shown.append(output("execute_result", of_value(value)) | {"execution_count": None})
    if figures:
        shown += [
            output("display_data", {"image/png": png(plt.figure(n))}) for n in plt.get_fignums()
        ]
    plt.close("all")
    return shown


def of_value(value: object) -> dict:
    """Return a value as Jupyter keeps it: as text, and as HTML where it has that."""
    data = {"text/plain": lines_of(repr(value))}
    html = getattr(value, "_repr_html_", lambda: None)()
    return data | ({"text/html": lines_of(html)} if html else {})


def output(kind: str, data: dict) -> dict:
    """Return an output of a cell."""
    return {"output_type": kind, "data": data, "metadata": {}}


def lines_of(text: str) -> list[str]:
    """Return a text as notebooks keep it."""
    return text.splitlines(keepends=True)


def png(figure: object) -> str:
    """Return a figure as notebooks keep it."""
    file = io.BytesIO()
    figure.savefig(file, format="png", dpi=80, metadata={"Software": None})
    return base64.b64encode(file.getvalue()).decode()


def refresh(path: Path) -> None:
    """Run a notebook, and keep what it shows in its file."""
    with tempfile.TemporaryDirectory() as folder:
        found = iter(run(path, Path(folder)))
    notebook = read(path)
    for cell in notebook["cells"]:
        if cell["cell_type"] == "code":
            cell["outputs"], cell["execution_count"] = next(found), None
    text = json.dumps(notebook, indent=1, ensure_ascii=False, sort_keys=True)
    path.write_text(text + "\n", encoding="utf-8")


def as_page(path: Path, folder: Path) -> None:
    """Write a notebook as a Markdown page of the site, its figures beside it."""
    page = folder / f"{path.stem}.md"
    parts = []
    for k, cell in enumerate(read(path)["cells"]):
        source = "".join(cell["source"])
        if cell["cell_type"] == "markdown":
            parts.append(source)
            continue
        parts.append(f"```python\n{source}\n```")
        for n, shown in enumerate(cell["outputs"]):
            data = shown.get("data", {})
            if "image/png" in data:
                name = f"{path.stem}_{k}_{n}.png"
                (folder / name).write_bytes(base64.b64decode(data["image/png"]))
                parts.append(f"![Figure of the cell above]({name})")
            elif "text/html" in data:
                html = "".join(data["text/html"]).replace("\n", " ")
                parts.append(f"```{{raw}} html\n{html}\n```")
            else:
                text = "".join(shown.get("text", data.get("text/plain", ""))).rstrip()
                parts.append(f"```text\n{text}\n```")
    page.write_text("\n\n".join(parts) + "\n", encoding="utf-8")


if __name__ == "__main__":
    os.environ.setdefault("MPLBACKEND", "Agg")
    for each in [Path(name).resolve() for name in sys.argv[1:]] or notebooks():
        refresh(each)
        sys.stdout.write(f"{each.name}\n")

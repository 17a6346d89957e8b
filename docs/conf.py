"""Settings of the documents as a site (Sphinx, MyST, furo); `python docs/build_site.py` builds it.

Nothing is loaded from outside: furo brings its scripts and styles, fonts of the text are the
reader's own, and KaTeX, which draws formulas, lies in `_static/katex` with its licence. Where
scripts are off a formula stands as it was written.
"""

import re
from html import escape

from docutils import nodes
from pydantic import BaseModel
from pygments.lexers.special import TextLexer
from sphinx.highlighting import lexers

from antinode import __version__

project = "antinode"
author = "The antinode developers"
copyright = author
release = version = __version__

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon", "sphinx_copybutton"]
root_doc = "docs/index"
source_suffix = {".md": "markdown", ".rst": "restructuredtext"}
suppress_warnings = ["ref.python"]  # names that two modules have
smartquotes = False

myst_heading_anchors = 4
myst_enable_extensions: list[str] = []
myst_fence_as_directive = ["math"]
copybutton_exclude = ".linenos, .gp, .go"

lexers["csv"] = TextLexer()

napoleon_google_docstring = False
napoleon_use_ivar = True
napoleon_use_param = False
napoleon_use_rtype = False
autodoc_member_order = "bysource"
autodoc_typehints = "signature"
_NAMES = (
    "Array Integers Complex Numbers Columns AxesArray ArrayLike npt.ArrayLike FamilyName "
    "Interpolation"
)
autodoc_type_aliases = {name: name.rpartition(".")[2] for name in _NAMES.split()}
autodoc_default_options = {"members": True}
python_use_unqualified_type_names = True
python_maximum_signature_line_length = 88

html_theme = "furo"
html_static_path = ["_static"]
html_css_files = ["katex/katex.min.css"]
html_js_files = [("katex/katex.min.js", {"defer": "defer"}), ("formulas.js", {"defer": "defer"})]
html_math_renderer = "katex"
html_title = f"antinode {version}"
html_copy_source = False
html_show_sourcelink = False
html_show_copyright = False
html_theme_options = {
    "light_css_variables": {"color-brand-primary": "#0072B2", "color-brand-content": "#0072B2"},
    "dark_css_variables": {"color-brand-primary": "#56B4E9", "color-brand-content": "#56B4E9"},
}


def types_as_words(app, what, name, obj, options, lines):
    """Put the type of an attribute, such as "array, shape (n,)", before its meaning, as words."""
    types = {}
    for line in [each for each in lines if each.startswith(":vartype ")]:
        key, _, text = line.removeprefix(":vartype ").partition(": ")
        types[key] = text
        lines.remove(line)
    for k, line in enumerate(lines):
        head, _, text = line.removeprefix(":ivar ").partition(":")
        if line.startswith(":ivar ") and head in types:
            lines[k] = f":ivar {head}: *{types[head]}* – {text.strip()}".rstrip(" –")


def plain_signature(app, what, name, obj, options, signature, returned):
    """Show types by their last names; of a table of a file its keys, whose types the fields say."""
    if what == "class" and issubclass(obj, BaseModel):
        keys = (f.alias or key for key, f in obj.model_fields.items())
        return f"(*, {', '.join(keys)})", None
    return tuple(text and plain_types(text) for text in (signature, returned))


def plain_types(text):
    """Take modules off names; arrays inside other types, which aliases do not reach, are Arrays."""
    plain = re.sub(r"~?\b(?:\w+\.)+(?=[A-Za-z])", "", text)
    return re.sub(r"ndarray\[tuple\[Any, \.\.\.\], dtype\[\w+\]\]", "Array", plain)


def aliases_as_words(app, tree):
    """Name arrays as people do in what an alias stands for."""
    for node in tree.findall(nodes.paragraph):
        if "ndarray[tuple" in node.astext():
            node.children = [nodes.Text(plain_types(node.astext()))]


def formula(translator, node):
    """Write a formula for KaTeX, as it is."""
    block = isinstance(node, nodes.math_block)
    tag, kind = ("div", "formula block") if block else ("span", "formula")
    translator.body.append(f'<{tag} class="{kind}">{escape(node.astext())}</{tag}>')
    raise nodes.SkipNode


def setup(app):
    """Connect to Sphinx, after napoleon."""
    app.add_html_math_renderer("katex", (formula, None), (formula, None))
    app.connect("autodoc-process-signature", plain_signature)
    app.connect("doctree-read", aliases_as_words)
    app.connect("autodoc-process-docstring", types_as_words, priority=900)

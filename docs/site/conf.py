"""The documentation site: cmake --build --preset release --target site (cmake/Site.cmake).

Its pages are the Markdown files of the repository. Sphinx reads them through a folder of links that has the layout of
the repository, so that a relative link leads on the site to
- the page, also with #heading, where its target is a Markdown file of the site, or a folder with a README.md of it;
- a copy in _downloads/, where its target is another file, such as a source or a case;
- nowhere, and is text alone, where its target is another folder or page.
What does not exist, images included, fails the build. Nothing is loaded from the network.
"""
import collections
import itertools
import pathlib
import subprocess
from xml.etree import ElementTree

from sphinx.domains.cpp import CPPDomain
from sphinx.util.nodes import make_refnode

ROOT = pathlib.Path(__file__).resolve().parents[2]
NORMALIZE = pathlib.Path("/usr/share/javascript/normalize.css/normalize.css")  # the package of furo depends on it

project = html_title = "Tunica"
include_patterns = ["*.md", "docs/*.md", "examples/*/README.md", "meshes/README.md", "src/REFERENCES.md",
                    "xml/PARAMETERS.md", "bench/**/RESULTS.md", "xml/**/RESULTS.md", "api/*.rst"]
extensions = ["myst_parser", "breathe"]
myst_heading_anchors = 6  # headings have the names that GitHub gives them
myst_ref_domains = ["std"]  # a link leads to a page or a heading, not to a class of the same name
suppress_warnings = ["misc.highlighting_failure"]  # code may be an excerpt that is no whole XML
breathe_default_project = "tunica"
breathe_default_members = ("members", "protected-members", "undoc-members")

html_theme = "furo"
html_static_path = html_css_files = ["site.css"]
html_copy_source = html_show_copyright = False
toc_object_entries = False  # a folder has hundreds of functions


def link_repository(app):
    """Fills the folder that Sphinx reads; not with the build folder, whatever its name, in which that lies itself."""
    source = pathlib.Path(app.srcdir)
    for path in ROOT.iterdir():
        if path.name not in {".git", "build", "results"} and path not in source.parents:
            (source / path.name).symlink_to(path)
    (source / "index.md").symlink_to(ROOT / "docs/site/index.md")


def run_doxygen(headers, folder):
    """As docs/Doxyfile.in, but XML of these headers alone; the target `reference` shows what Doxygen warns of."""
    settings = {"@INCLUDE": ROOT / "docs/Doxyfile.in", "INPUT": " ".join(str(ROOT / "src" / name) for name in headers),
                "STRIP_FROM_PATH": ROOT / "src", "OUTPUT_DIRECTORY": folder, "XML_OUTPUT": ".",
                "GENERATE_XML": "YES", "GENERATE_HTML": "NO", "WARNINGS": "NO", "WARN_AS_ERROR": "NO"}
    text = "".join(f"{key} = {value}\n" for key, value in settings.items())
    subprocess.run(["doxygen", "-"], input=text, text=True, check=True, stdout=subprocess.DEVNULL)


def declarations(folder):
    """(header, line, kind, name, arguments) of each class, free function, type and macro in the XML of Doxygen.
    Breathe's doxygenfile needs no such list, but repeats the namespaces in each header, which Sphinx warns of."""
    for file in folder.glob("*.xml"):
        compound = ElementTree.parse(file).find("compounddef")
        kind = "" if compound is None else compound.get("kind")
        found = [compound] if kind in ("class", "struct") else []
        for item in compound.iter("memberdef") if kind in ("file", "namespace") else found:
            place = item.find("location")
            name = item.findtext("qualifiedname") or item.findtext("compoundname") or item.findtext("name")
            yield place.get("file"), int(place.get("line")), item.get("kind"), name, item.findtext("argsstring") or ""


def write_api(app):
    """A page for each folder of public headers, in which Breathe puts the text of Doxygen."""
    listed = (ROOT / "cmake/public_headers.txt").read_text().split("\n")
    xml = app.config.breathe_projects["tunica"]
    run_doxygen([line for line in listed if line.startswith("tunica/")], xml)
    found = sorted(declarations(pathlib.Path(xml)))
    classes = {name for _, _, kind, name, _ in found if kind in ("class", "struct")}
    overloads = collections.Counter(name for _, _, _, name, _ in found)
    pages = collections.defaultdict(list)
    for header, entries in itertools.groupby(found, key=lambda entry: entry[0]):
        lines = pages[header.split("/")[1]]
        lines += [header, "-" * 80, ""]
        for _, _, kind, name, arguments in entries:
            if name.rpartition("::")[0] not in classes and "::detail::" not in name:  # members come with their class
                lines += [f".. doxygen{kind}:: {name}{arguments if overloads[name] > 1 else ''}", ""]
    for folder, lines in pages.items():
        pathlib.Path(app.srcdir, "api", f"{folder}.rst").write_text("\n".join([f"tunica/{folder}", "=" * 80, "", *lines]))


def find_folder(app, env, node, text):
    """What a link to a folder leads to: the page of its README.md, or nothing, as one to a page that is not shown."""
    target = pathlib.Path(app.srcdir, node["refdoc"]).parent / node["reftarget"]
    page = env.path2doc(str(target / "README.md"))
    if page in env.found_docs:
        return make_refnode(app.builder, node["refdoc"], page, "", text)
    return text if target.exists() else None


def mend_theme(app, error):
    """Debian's furo expects a web server: it takes a file from /javascript/, and its script loads as a module only."""
    scripts, styles = (pathlib.Path(app.outdir, "_static", name) for name in ("scripts", "styles"))
    for file, line, other in (
            (styles / "furo.css", b"@import url(/javascript/normalize.css/normalize.css);", NORMALIZE),
            (scripts / "furo.js", b'import Gumshoe from "./gumshoe-patched.js";', scripts / "gumshoe-patched.js")):
        if not error:
            file.write_bytes(file.read_bytes().replace(line, other.read_bytes()))


class Declared(CPPDomain):
    """Without parameters, which would fill the results of a search: each is named by its function, too."""

    def get_objects(self):
        return (found for found in super().get_objects() if not found[2].endswith("Param"))


def setup(app):
    app.add_domain(Declared, override=True)
    app.connect("builder-inited", link_repository)
    app.connect("builder-inited", write_api)
    app.connect("missing-reference", find_folder)
    app.connect("build-finished", mend_theme)

# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""Holds the one-definition rule over all C++ of the project, without compiling it.

A linker sees two functions of one name, but never two structs, and of two inline functions it silently keeps one. So
this reads every .h and .cpp, follows the namespaces, and takes what is defined there with external linkage: types,
enumerations, inline variables, and functions with the types of their parameters. What two files define under one name
is reported. Unnamed namespaces, `static` functions and specialisations of templates are free; a header has no unnamed
namespace, which would be another one in each file that includes it. The tests of each folder are one program.
Release builds compile files of a folder together, a small one with its neighbour's, so there the names of unnamed
namespaces are told apart as well; a test has them in a namespace named after its file.

Not seen: names that macros make, and one header compiled in two ways.
"""
import collections
import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[1]
HOUSE = ("application", "metrics", "packaging", "porttool", "render_system", "source_core", "target_core")
TOGETHER = ("application/", "metrics/", "porttool/", "render_system/",  # cmake/by_folder.cmake
            "tests/application/", "tests/metrics/", "tests/porttool/", "tests/render_system/")
# cmake/by_folder.cmake: small folders are compiled with the files of another.
NEIGHBOURS = dict(pair.split("=") for pair in re.search(
    r"set\(neighbours ([^)]*)\)", (ROOT / "cmake/by_folder.cmake").read_text()).group(1).split())
# Files in whose place another one is taken: by the build, or (lanes) by a macro that also renames their namespace.
ALTERNATIVES = {"porttool/spirv/no_spirv.cpp", "target_core/device/lanes_avx2.h", "target_core/device/lanes_avx512.h",
                "target_core/device/wide_lanes.h", "target_core/device/wide_trace.h"}

TOKEN = re.compile(
    r"""//(?:\\\n|[^\n])*|/\*.*?\*/|^[ \t]*\#(?:\\\n|[^\n])*      # comments, directives
    |(?P<raw>R"(?P<mark>[^(]*)\(.*?\)(?P=mark)")|"(?:\\.|[^"\\])*"|'(?:\\.|[^'\\])*'
    |[A-Za-z_]\w*|\d(?:'?[\w.])*|::|->|\S""", re.S | re.M | re.X)
CLOSERS = {"(": ")", "[": "]", "{": "}"}


def tokens_of(text):
    found = (match.group() for match in TOKEN.finditer(text))
    return [one for one in found if not one.startswith(("//", "/*")) and not one.lstrip().startswith("#")]


def end_of(tokens, at):
    """The place after the bracket that closes the one at `at`."""
    depth = 0
    for i in range(at, len(tokens)):
        depth += (tokens[i] in CLOSERS) - (tokens[i] in CLOSERS.values())
        if depth == 0:
            return i + 1
    return len(tokens)


def end_of_angles(tokens, at):
    depth = 0
    for i in range(at, len(tokens)):
        depth += {"<": 1, ">": -1}.get(tokens[i], 0)
        if depth == 0:
            return i + 1
    return len(tokens)


def without_prefixes(head):
    """A declaration without `template <...>`, `[[...]]` and `alignas(...)` before it, and whether it was a template."""
    template = False
    while head:
        if head[0] == "template":
            template = True
            head = head[end_of_angles(head, 1):] if head[1:2] == ["<"] else []
        elif head[:2] == ["[", "["]:
            head = head[end_of(head, 0):]
        elif head[0] == "alignas":
            head = head[end_of(head, 1):]
        elif head[0] in ("requires", "typedef"):
            return [], template
        else:
            break
    return head, template


def type_name(head):
    """`struct Name final : Base` gives Name; nothing for a specialisation or an unnamed type."""
    rest, _ = without_prefixes(head[2:] if head[:2] == ["enum", "class"] or head[:2] == ["enum", "struct"] else head[1:])
    name = ""
    for token in rest:
        if token in ("final", ":"):
            break
        if token == "<":
            return ""
        name += token
    return name


def parameter_types(tokens):
    """The types between the brackets of a function's head, as far as tokens tell them from names."""
    out, one, depth, default = [], [], 0, False
    for token in tokens + [","]:
        depth += (token in "(<[{") - (token in ")>]}") if len(token) == 1 else 0
        if token == "," and depth == 0:
            named = len(one) > 1 and re.match(r"[A-Za-z_]", one[-1]) and one[-2] not in ("const", "::", "struct")
            out.append(" ".join(one[:-1] if named else one))
            one, default = [], False
        else:
            default = default or (token == "=" and depth == 0)
            if not default:
                one.append(token)
    return ", ".join(out)


def function_name(head):
    """The name and parameters of a function that has a body; nothing for a variable."""
    at = 0
    while at < len(head) and head[at] not in ("(", "="):
        if head[at] == "operator":
            at += 3 if head[at + 1:at + 3] == ["(", ")"] else 1
            while at < len(head) and head[at] != "(":
                at += 1
            break
        at = end_of_angles(head, at) if head[at] == "<" else at + 1
    if at >= len(head) or head[at] != "(":
        return ""
    start = at - 1
    if "operator" in head[:at]:
        start = head.index("operator")
    while start > 1 and head[start - 1] == "::":
        start -= 2
    return "".join(head[start:at]) + "(" + parameter_types(head[at + 1:end_of(head, at) - 1]) + ")"


def definition_in(head, template):
    """What a declaration with a body, or with a value, defines: its name, or nothing."""
    if not head or not re.match(r"[A-Za-z_~]|::", head[0]):
        return ""
    if head[0] in ("struct", "class", "union", "enum") and "(" not in head and "=" not in head:
        return type_name(head)
    if "static" in head or head[0] in ("using", "static_assert", "friend", "concept"):
        return ""
    function = function_name(head)
    if function:
        return function
    value = next((i for i, token in enumerate(head) if token in "={;"), len(head))
    return head[value - 1] if "inline" in head and value > 1 else ""


def constants_in(declaration):
    """`constexpr int kFew = 2, kMany[] = 9` defines both."""
    out, depth, name = [], 0, ""
    for token in declaration:
        depth += (token in CLOSERS) - (token in CLOSERS.values())
        if token == "=" and depth == 0:
            out.append(name)
        elif depth == 0 and re.match(r"[A-Za-z_]", token):
            name = token
    return out


def definitions(text):
    """The names that a file defines with external linkage, and those in its unnamed namespaces; None if it has none."""
    tokens, at, scopes, head, names, local = tokens_of(text), 0, [], [], set(), None
    while at < len(tokens):
        token = tokens[at]
        if token == "}":
            scopes = scopes[:-1]
            at, head = at + 1, []
        elif token == "{" and "namespace" in head[:2]:
            scopes.append("".join(head[head.index("namespace") + 1:]) or None)
            local = set() if scopes[-1] is None and local is None else local
            at, head = at + 1, []
        elif token == "{" and head[:1] == ["extern"] and len(head) == 2:
            scopes.append("")
            at, head = at + 1, []
        elif token in "{;":
            declaration, template = without_prefixes(head)
            is_body = token == "{"
            name = definition_in(declaration, template) if is_body or "inline" in declaration else ""
            if not is_body and "(" in name:
                name = ""
            found = [name] if name else []
            if None in scopes and not name and {"const", "constexpr"} & set(declaration) and declaration[0] != "using":
                found = constants_in(declaration)
            for one in found:
                (local if None in scopes else names).add("::".join([scope for scope in scopes if scope] + [one]))
            at, head = (end_of(tokens, at) if is_body else at + 1), []
            if is_body and at < len(tokens) and tokens[at] in ",;)":  # the rest of an initialiser
                at += tokens[at] == ";"
        elif token in "([":
            end = end_of(tokens, at)
            head += tokens[at:end]
            at = end
        else:
            head.append(token)
            at += 1
    return names, local


def compiled_with(folder):
    for name, neighbour in NEIGHBOURS.items():
        folder = re.sub(f"(^|/){name}$", f"\\1{neighbour}", folder)
    return folder


def problems_in(files):
    """What breaks the rule in (path, names, local names) of one program, a line each."""
    places, out = collections.defaultdict(set), []
    for path, names, local in files:
        for name in names - {"main()", "main(int, char * *)", "pathtracer_core()"}:  # where a program or a module is entered
            places[name].add(path)
        for name in (local or ()) if path.startswith(TOGETHER) else ():
            places[name + " in " + compiled_with(path.rpartition("/")[0])].add(path)
        if local is not None and path.endswith(".h"):
            out.append(f"{path}: an unnamed namespace in a header; name it, or move what it holds")
    for name, paths in sorted(places.items()):
        if len(paths) > 1:
            out.append(f"{name} is defined in {', '.join(sorted(paths))}; rename one to what it is")
    return out


def read(folder):
    paths = sorted(path for path in folder.rglob("*") if path.suffix in (".h", ".cpp") and "fixtures" not in path.parts)
    names = [(path, str(path.relative_to(ROOT))) for path in paths]
    return [(name, *definitions(path.read_text())) for path, name in names if name not in ALTERNATIVES]


class OneDefinition(unittest.TestCase):
    def found(self, *texts):
        return problems_in([(f"{i}.cpp", *definitions(text)) for i, text in enumerate(texts)])

    def test_the_project(self):
        house = sum((read(ROOT / folder) for folder in HOUSE), [])
        self.assertGreater(sum(len(names) for _, names, _ in house), 1000)  # it does read them
        self.assertEqual(problems_in(house), [])
        for folder in sorted(path for path in (ROOT / "tests").iterdir() if path.is_dir()):
            self.assertEqual(problems_in(house + read(folder)), [], folder.name)

    def test_two_types_of_one_name(self):
        for one, other in [
                ("struct Similarity { int a; };", "struct Similarity { float b = 0; };"),
                ("enum class Vocabulary : uint8_t { Raw };", "class Vocabulary {\npublic:\n int id(); };"),
                ("struct [[nodiscard]] Similarity final : Base<int, 2> {};", "union Similarity { int a; };"),
                ("template <class T>\nstruct Similarity {};", "extern \"C\" { struct Similarity {}; }")]:
            name = "Vocabulary" if "Vocabulary" in one else "Similarity"
            self.assertEqual(self.found("namespace porttool {" + one + "}", "namespace porttool {\n" + other + "\n}"),
                             [f"porttool::{name} is defined in 0.cpp, 1.cpp; rename one to what it is"])

    def test_two_functions_of_one_name(self):
        for one, other in [
                ("inline int f(int a, const char* b = \"{\") { return a; }", "inline int f(int x, const char* y) { return 2; }"),
                ("inline bool a::operator==(const a& x) const { return 1; }", "inline bool a::operator==(const a& y) const {}"),
                ("constexpr int f() { return 1; }", "template <class T> requires x int f() { return 2; } int f() {}"),
                ("inline constexpr int kMost = 4;", "inline int kMost{5};"),
                ("A::A(int x) : a_{x}, b_(x) {}", "A::A(int y) : b_(y), a_{y} {}")]:
            self.assertEqual(len(self.found("namespace n {" + one + "}", "namespace n {" + other + "}")), 1, one)

    def test_what_is_free(self):
        twice = ["namespace n { namespace { struct A { int x; }; inline int f() { return 1; } } }",
                 "static int f(int a) { return a; }", "struct A; enum class B : int; int f(); extern int x;",
                 "template <> struct hash<A> {};", "constexpr int kMost = 4; const std::string kName{\"a\"};",
                 "using Files = std::vector<int>;", "// struct A {};\n/* struct A {}; */ #define B struct A {}",
                 "auto x = [] { struct A {}; };", 'const char* t = R"(struct A {};)";']
        for text in twice:
            self.assertEqual(self.found(text, text), [], text)
        self.assertEqual(self.found("inline int f(int a) { return a; }", "inline int f(float a) { return 1; }"), [])
        self.assertEqual(self.found("namespace a { struct A {}; }", "namespace b { struct A {}; } struct A {};"), [])

    def test_local_names_of_one_folder(self):
        def found(*paths):
            texts = ("namespace n { namespace { bool f(int a) { return a; } constexpr int kMost = 4; } }",
                     "namespace n { namespace { constexpr int kMost = 5; } bool f(int a); }")
            return problems_in([(path, *definitions(text)) for path, text in zip(paths, texts)])
        self.assertEqual(found("porttool/a/x.cpp", "porttool/a/y.cpp"),
                         ["n::kMost in porttool/a is defined in porttool/a/x.cpp, porttool/a/y.cpp; rename one to what it is"])
        self.assertEqual(found("porttool/a/x.cpp", "porttool/b/y.cpp"), [])
        both = "namespace n { namespace { constexpr int kFew = 2, kMost = g(1, 2); const char* const kWord = \"\"; } }"
        names = [definitions(text)[1] for text in (both, "namespace n { namespace { const size_t kMost = 5; } }")]
        self.assertEqual(names, [{"n::kFew", "n::kMost", "n::kWord"}, {"n::kMost"}])
        self.assertEqual(len(found("porttool/history/x.cpp", "porttool/effort/y.cpp")), 1, "compiled together")
        self.assertEqual(len(found("tests/porttool/x.cpp", "tests/porttool/y.cpp")), 1)
        self.assertEqual(found("tests/physics/x.cpp", "tests/physics/y.cpp"), [])

    def test_unnamed_namespaces_in_headers(self):
        self.assertEqual(len(problems_in([("a.h", *definitions("namespace n { namespace { int x; } }"))])), 1)


if __name__ == "__main__":
    unittest.main()

#!/usr/bin/env python3
"""Names that a file uses without including their header, itself or through headers of ours.

Precompiled headers hide that until somebody builds without them. Looks for the names of what
is precompiled (CMakeLists.txt, tests/CMakeLists.txt) except <utility>, <type_traits> and <cstddef>,
which every container brings along.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
# Header -> what shows that it is used.
NAMES = {
    "algorithm": r"std::(ranges::)?(adjacent_find|all_of|any_of|binary_search|clamp|copy|copy_if|copy_n|count|count_if"
                 r"|equal|fill|fill_n|find|find_if|for_each|generate|is_sorted|lower_bound|max|max_element|min"
                 r"|min_element|minmax|minmax_element|none_of|nth_element|partial_sort|partition|remove_if|reverse"
                 r"|rotate|sort|stable_sort|transform|unique|upper_bound)\(",
    "array": r"std::array\b",
    "cmath": r"std::(acos|asin|atan|atan2|cbrt|ceil|copysign|cos|cosh|erf|erfc|exp|expm1|fabs|floor|fmod|hypot"
             r"|isfinite|isinf|isnan|lgamma|llround|log|log10|log1p|log2|lround|nextafter|pow|remainder|round"
             r"|signbit|sin|sinh|sqrt|tan|tanh|tgamma|trunc)\(",
    "cstdint": r"std::u?int(8|16|32|64)_t\b",
    "filesystem": r"std::filesystem\b",
    "functional": r"std::(cref|function|greater|hash|invoke|less|plus|ref|reference_wrapper)\b",
    "limits": r"std::numeric_limits\b",
    "map": r"std::map\b",
    "memory": r"std::(make_shared|make_unique|shared_ptr|unique_ptr)\b",
    "numbers": r"std::numbers::",
    "numeric": r"std::(accumulate|gcd|inner_product|iota|lcm|midpoint|partial_sum|reduce|transform_reduce)\b",
    "optional": r"std::(optional|nullopt)\b",
    "span": r"std::span\b",
    "stdexcept": r"std::(domain_error|invalid_argument|length_error|logic_error|out_of_range|runtime_error)\b",
    "string": r"std::(string|to_string|getline|stod|stoi)\b",
    "string_view": r"std::string_view\b",
    "vector": r"std::vector\b",
    "Eigen/Core": r"\bEigen::",
    "Eigen/Geometry": r"\bEigen::(Affine3d|AngleAxisd|Isometry3d|Quaterniond|Rotation2Dd|Translation3d)\b",
    "fmt/format.h": r"\bfmt::",
    "gmock/gmock.h": r"\bEXPECT_THAT\(|\btesting::(ElementsAre|HasSubstr|Not)\(",
    "gtest/gtest.h": r"\b(ASSERT|EXPECT)_(EQ|FALSE|LT|NEAR|TRUE)\(|\bTEST(_F|_P)?\(",
}
GIVES = {
    "Eigen/Cholesky": {"Eigen/Core"},
    "Eigen/Eigenvalues": {"Eigen/Core", "Eigen/Geometry"},
    "Eigen/Geometry": {"Eigen/Core"},
    "Eigen/LU": {"Eigen/Core"},
    "Eigen/QR": {"Eigen/Core"},
    "Eigen/SVD": {"Eigen/Core"},
    "gmock/gmock.h": {"gtest/gtest.h"},
    "string": {"string_view"},
}


def included(path, known={}):
    """Our headers that a file includes, and the names of those of others."""
    if path not in known:
        ours, others = [], set()
        for quote, name in re.findall(r'^\s*#\s*include\s*([<"])([^>"]+)', path.read_text(), re.M):
            places = [path.parent, ROOT / "lib", ROOT] if quote == '"' else []
            header = next((place / name for place in places if (place / name).is_file()), None)
            if header:
                ours.append(header.resolve())
            else:
                others |= {name} | GIVES.get(name, set())
        known[path] = ours, others
    return known[path]


def within_reach(path):
    seen, todo, reached = {path}, [path], set()
    while todo:
        ours, others = included(todo.pop())
        reached |= others
        todo += [header for header in ours if header not in seen]
        seen.update(ours)
    return reached


def code_of(path):
    """Without comments and what is in quotes."""
    text = re.sub(r"//[^\n]*|/\*.*?\*/", "", path.read_text(), flags=re.S)
    return re.sub(r'"(\\.|[^"\\\n])*"', '""', text)


def missing(path):
    reached, code = within_reach(path), code_of(path)
    for header, names in NAMES.items():
        found = None if header in reached else re.search(names, code)
        if found:
            yield f"{path.relative_to(ROOT)}: {found.group(0).rstrip('(')} without <{header}>"


def main():
    paths = [path for folder in ("lib", "apps", "tests") for path in sorted((ROOT / folder).rglob("*"))
             if path.suffix in (".h", ".cpp")]
    if not paths:
        sys.exit("no sources found")
    found = [line for path in paths for line in missing(path)]
    print("\n".join(found) or f"{len(paths)} files include what they use of the precompiled headers")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())

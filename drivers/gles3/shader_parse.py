"""Reads one program's .glsl file: stages, includes, flags. The format is described in shader_table.py."""
import re
from dataclasses import dataclass, field
from pathlib import Path

STAGES = ("vertex", "fragment")
INCLUDE = re.compile(r'\s*#\s*include\s*"([^"]*)"\s*$')
PRAGMA = re.compile(r"\s*#\s*pragma\s+(flags|validate|stage|share)\b\s*(.*?)\s*$")
FLAG = re.compile(r"[A-Z][A-Z0-9_]*$")
CONDITION = re.compile(r"\s*#\s*(?:ifdef|ifndef|if|elif)\b(.*)$")
DEFINE = re.compile(r"\s*#\s*define\s+([A-Za-z_]\w*)")
MAX_FLAGS = 32


class ShaderError(Exception):
    """A fault of a .glsl file; prints as `file:line: error: ...`."""

    def __init__(self, file, line, message):
        super().__init__(f"{file}:{line}: error: {message}")


@dataclass
class Stage:
    """One stage's text after expansion. `origin[i]` is the (file number, line) that line i of `lines` came from."""
    lines: list = field(default_factory=list)
    origin: list = field(default_factory=list)
    included: set = field(default_factory=set)

    def text(self):
        """The lines with #line directives wherever the origin is not simply the next line."""
        out, expected = [], None
        for line, (file, number) in zip(self.lines, self.origin):
            if (file, number) != expected:
                out.append(f"#line {number} {file}")
            out.append(line)
            expected = (file, number + 1)
        return "\n".join(out) + "\n"


@dataclass
class Program:
    name: str
    files: list = field(default_factory=list)  # by file number; paths from the repository's root
    flags: list = field(default_factory=list)
    validate: list = field(default_factory=list)  # lists of flags
    shares: dict = field(default_factory=dict)  # sampler -> the one whose unit it takes
    stages: dict = field(default_factory=dict)

    def key(self, flags):
        """The variant's number: bit i for flag i."""
        return sum(1 << self.flags.index(f) for f in flags)


class Reader:
    def __init__(self, path, root):
        self.folder = path.parent
        self.root = root
        self.program = Program(path.stem)
        self.current = list(STAGES)  # where lines go
        self.expand(path, is_program=True)

    def label(self, path):
        """From the repository's root, as messages name it; shaders that lie elsewhere keep their whole path."""
        full, root = path.resolve(), self.root.resolve()
        return full.relative_to(root).as_posix() if full.is_relative_to(root) else full.as_posix()

    def number_of(self, path):
        label = self.label(path)
        if label not in self.program.files:
            self.program.files.append(label)
        return self.program.files.index(label)

    def expand(self, path, is_program):
        number = self.number_of(path)
        depth = 0  # of #if
        for i, line in enumerate(path.read_text(encoding="utf-8").split("\n"), 1):
            def fault(message, i=i):
                return ShaderError(self.label(path), i, message)
            directive = line.lstrip()
            depth += directive.startswith(("#if", "# if")) - directive.startswith(("#endif", "# endif"))
            if directive.startswith("#version"):
                raise fault("expected no #version (the build puts it in front), found one")
            if pragma := PRAGMA.match(line):
                if not is_program:
                    raise fault(f"expected no `#pragma {pragma[1]}` in a library, found one")
                self.pragma(pragma[1], pragma[2].split(), fault)
            elif include := INCLUDE.match(line):
                if depth:
                    raise fault("expected #include outside every #if, found it inside one")
                self.include(include[1], fault)
            else:
                for name in self.current:
                    stage = self.program.stages.setdefault(name, Stage())
                    stage.lines.append(line)
                    stage.origin.append((number, i))
        if depth:
            raise ShaderError(self.label(path), i, "expected #endif, found the end of the file")

    def include(self, name, fault):
        path = self.folder / name
        if not path.is_file():
            raise fault(f"expected a file of the shaders folder, found \"{name}\"")
        wanted = [s for s in self.current if name not in self.program.stages.setdefault(s, Stage()).included]
        for stage in wanted:
            self.program.stages[stage].included.add(name)
        if wanted:
            outer, self.current = self.current, wanted
            self.expand(path, is_program=False)
            self.current = outer

    def pragma(self, kind, words, fault):
        program = self.program
        if kind == "stage":
            if len(words) != 1 or words[0] not in STAGES:
                raise fault(f"expected a stage, vertex or fragment, found \"{' '.join(words)}\"")
            self.current = words
            return
        if kind == "share":
            if len(words) != 2:
                raise fault(f"expected two samplers, found \"{' '.join(words)}\"")
            program.shares[words[0]] = words[1]
            return
        for word in words:
            if kind == "flags" and (not FLAG.match(word) or word in program.flags):
                raise fault(f"expected a new flag in capitals, found \"{word}\"")
            if kind == "validate" and word not in program.flags:
                raise fault(f"expected a flag of this program, found \"{word}\"")
        if kind == "flags":
            program.flags += words
            if len(program.flags) > MAX_FLAGS:
                raise fault(f"expected at most {MAX_FLAGS} flags, found {len(program.flags)}")
        else:
            program.validate.append(words)


def check_conditions(program):
    """A misspelt flag would be off for ever: every name in a condition must be a flag or be defined."""
    for stage in program.stages.values():
        known = set(program.flags) | {m[1] for line in stage.lines if (m := DEFINE.match(line))} | {"defined"}
        for line, (file, number) in zip(stage.lines, stage.origin):
            condition = CONDITION.match(line.split("//")[0])
            for name in re.findall(r"[A-Za-z_]\w*", condition[1]) if condition else []:
                if name not in known and not name.startswith("GL_"):
                    raise ShaderError(program.files[file], number, f"expected a flag or a #define, found \"{name}\"")


def read_program(path, root):
    """@return Program. Raises ShaderError."""
    path = Path(path)
    reader = Reader(path, Path(root))
    program = reader.program
    if not program.validate:
        raise ShaderError(program.files[0], 1, "expected at least one `#pragma validate` line, found none")
    for stage in STAGES:
        if not any("main" in line for line in program.stages.get(stage, Stage()).lines):
            raise ShaderError(program.files[0], 1, f"expected a main() after `#pragma stage {stage}`, found none")
    check_conditions(program)
    return program

# SPDX-License-Identifier: Apache-2.0
"""Reads include/bdpt.h for the scripts that check it and that make its reference.

It knows how that file is written by hand, and nothing else of C. What it does not know is an error (Unknown), so that
nothing is left out in silence.
"""
import bisect
import dataclasses
import pathlib
import re

DEFAULT = pathlib.Path(__file__).resolve().parent.parent / 'include' / 'bdpt.h'
LABELS = ('Returns', 'Threads', 'Callbacks', 'Ownership', 'Source')


class Unknown(Exception):
    """The header has something that this parser does not know."""


@dataclasses.dataclass
class Section:
    """A banner, the text below its title, and what follows up to the next banner."""
    title: str
    text: list
    items: list


@dataclasses.dataclass
class Text:
    """A comment that belongs to no declaration; title is that of a `--- title ---`, if it has one."""
    title: str
    text: list
    line: int


@dataclasses.dataclass
class Constant:
    name: str
    value: str
    comment: list
    line: int


@dataclasses.dataclass
class Handle:
    """typedef struct name name;"""
    name: str
    comment: list
    line: int


@dataclasses.dataclass
class Alias:
    """typedef type name; with the constants of that type, and the comments among them, in order."""
    name: str
    type: str
    comment: list
    members: list
    line: int

    @property
    def constants(self):
        return [m for m in self.members if isinstance(m, Constant)]


@dataclasses.dataclass
class Callback:
    """typedef type (*name)(parameters);"""
    name: str
    declaration: str
    comment: list
    line: int


@dataclasses.dataclass
class Field:
    """A field, or several that share one declaration and one comment."""
    names: list
    declaration: str
    comment: list
    line: int
    span: tuple  # of the declaration in Header.source

    @property
    def type(self):
        """The declaration without the name; with several names, without the names and their brackets."""
        if len(self.names) > 1:
            first = re.match(rf'(.*?)\b{self.names[0]}\b(\[[^\]]*\])*', self.declaration)
            return first[1].strip() + (first[2] or '')
        return re.sub(rf' ?\b{self.names[0]}\b', '', self.declaration, count=1).strip()


@dataclasses.dataclass
class Struct:
    name: str
    comment: list
    fields: list
    line: int

    @property
    def sized(self):
        return self.fields[0].names == ['struct_size']


@dataclasses.dataclass
class Function:
    name: str
    declaration: str  # without BDPT_API and BDPT_CHECK
    checked: bool     # has BDPT_CHECK
    comment: list
    line: int

    @property
    def result(self):
        return self.declaration[:self.declaration.index(self.name)].strip()

    def paragraphs(self):
        """The comment's text and its labelled paragraphs: [('', text), ('Returns', text), ...]"""
        parts = re.split(rf'(?:^|(?<=\s))({"|".join(LABELS)}):(?=\s|$)', '\n'.join(self.comment))
        return [('', parts[0].strip())] + [(l, t.strip()) for l, t in zip(parts[1::2], parts[2::2])]


class Header:
    """title: what the first line says. text: the rest of the first comment. sections: what follows."""

    def __init__(self, path=DEFAULT):
        self.path = pathlib.Path(path)
        self.source = self.path.read_text(encoding='utf-8')
        self._newlines = [i for i, c in enumerate(self.source) if c == '\n']
        first = re.match(r'/\*(.*?)\*/', self.source, re.S)
        body = re.search(r'extern "C" \{\n#endif\n', self.source)
        end = self.source.rfind('#ifdef __cplusplus\n}\n#endif\n')
        if not (first and body and end > 0):
            raise Unknown(f'{self.path}: no comment at the beginning, or no extern "C"')
        self.title, *self.text = _lines(first[1])
        self.sections = []
        self._read(body.end(), end)

    def items(self, kind):
        return [i for s in self.sections for i in s.items if isinstance(i, kind)]

    @property
    def functions(self):
        return self.items(Function)

    @property
    def structs(self):
        return self.items(Struct)

    @property
    def constants(self):
        return [c for i in self.items((Alias, Constant)) for c in (i.constants if isinstance(i, Alias) else [i])]

    def names(self):
        """Every name that the header declares, with its item; fields as struct.field."""
        found = {c.name: c for c in self.constants}
        found.update((i.name, i) for i in self.items((Handle, Alias, Callback, Struct, Function)))
        found.update((f'{s.name}.{n}', f) for s in self.structs for f in s.fields for n in f.names)
        return found

    def comments(self):
        """Every comment as (line, lines of text)."""
        for found in re.finditer(r'/\*(.*?)\*/', self.source, re.S):
            yield self._line(found.start()), _lines(found[1])

    # --- Reading ---

    def _line(self, place):
        return bisect.bisect_left(self._newlines, place) + 1

    def _unknown(self, place):
        line = self.source[place:].split('\n', 1)[0]
        return Unknown(f'{self.path}:{self._line(place)}: not understood: {line}')

    def _read(self, place, end):
        source, comment, group = self.source, None, None
        while place < end:
            blank = re.compile(r'\n*').match(source, place)
            if blank.end() > place:
                # What stands directly below a comment is what it is about; a blank line ends that, and a group.
                if '\n\n' in blank[0]:
                    self._loose(comment, group)
                    comment = group = None
                place = blank.end()
                continue
            found = _ITEM.match(source, place)
            if not found or found.end() > end:
                raise self._unknown(place)
            kind, line = found.lastgroup, self._line(place)
            if kind == 'comment':
                self._loose(comment, group)
                comment = (line, _lines(found['text']))
                if not comment[1] or not self.sections and not comment[1][0].startswith('------'):
                    raise self._unknown(place)
                if comment[1][0].startswith('------'):
                    self.sections.append(Section(comment[1][1], _trim(comment[1][2:]), []))
                    comment = group = None
            else:
                text, comment = (comment[1] if comment else []), None
                item = self._item(found, kind, text, line)
                if kind == 'constant' and group:
                    if text:
                        group.members.append(Text('', text, line))
                        item.comment = _tail(found)
                    group.members.append(item)
                elif not self.sections:
                    raise self._unknown(place)
                elif item:
                    self.sections[-1].items.append(item)
                    group = item if kind == 'alias' else None
            place = found.end()
        self._loose(comment, group)

    def _loose(self, comment, group):
        """Keeps a comment that no declaration follows."""
        if not comment:
            return
        line, text = comment
        title = re.fullmatch(r'--- (.*?)(?: ---)?', text[0])
        item = Text(title[1] if title else '', _trim(text[1:]) if title else text, line)
        (group.members if group else self.sections[-1].items).append(item)

    def _item(self, found, kind, text, line):
        if kind == 'constant':
            return Constant(found['cname'], found['value'].strip(), _tail(found) or text, line)
        if kind == 'handle':
            return Handle(found['hname'], text, line)
        if kind == 'alias':
            return Alias(found['aname'], found['atype'], text, [], line)
        if kind == 'callback':
            return Callback(found['bname'], _one_line(found['callback'][len('typedef '):-1]), text, line)
        if kind == 'function':
            return Function(found['fname'], _one_line(found['declaration']), bool(found['check']), text, line)
        if kind == 'struct':
            return Struct(found['sname'], text, self._fields(found.start('fields'), found.end('fields')), line)
        return None  # a forward declaration

    def _fields(self, place, end):
        fields = []
        while place < end:
            space = re.compile(r'\s*').match(self.source, place)
            place = space.end()
            if place >= end:
                break
            line = self._line(place)
            comment = _COMMENT.match(self.source, place)
            if comment and comment.end() <= end and fields and not fields[-1].comment:
                fields[-1].comment = _lines(comment['text'])
                place = comment.end()
                continue
            found = _FIELD.match(self.source, place)
            if not found or found.end() > end:
                raise self._unknown(place)
            declaration = _one_line(found[0][:-1])
            pointer = re.search(r'\(\*(\w+)\)\(', declaration)
            names = [pointer[1]] if pointer else [re.search(r'(\w+)(\[[^\]]*\])*$', part)[1]
                                                  for part in declaration.split(',')]
            fields.append(Field(names, declaration, [], line, found.span()))
            place = found.end()
        return fields


_COMMENT = re.compile(r'/\*(?P<text>.*?)\*/', re.S)
_FIELD = re.compile(r'[A-Za-z_](?:[^;{}/"]|/(?!\*))*;')
_ITEM = re.compile(r'''
    (?P<comment>/\*(?P<text>.*?)\*/)
  | (?P<constant>\#define\ (?P<cname>BDPT_\w+)\ (?P<value>[^\n/]+?)(?:\ */\*(?P<tail>.*?)\*/)?(?=\n))
  | (?P<handle>typedef\ struct\ (?P<hname>bdpt_\w+)\ (?P=hname);)
  | (?P<struct>typedef\ struct\ (?P<sname>bdpt_\w+)\ \{(?P<fields>[^{}]*)\}\ (?P=sname);)
  | (?P<forward>struct\ bdpt_\w+;)
  | (?P<alias>typedef\ (?P<atype>u?int\d+_t)\ (?P<aname>bdpt_\w+);)
  | (?P<callback>typedef\ [\w\ ]+\(\*(?P<bname>bdpt_\w+)\)\([^;()]*\);)
  | (?P<function>BDPT_API\ (?P<check>BDPT_CHECK\ )?(?P<declaration>[\w\ ]+[\ *](?P<fname>bdpt_\w+)\([^;()]*\));)
    ''', re.S | re.X)


def _one_line(text):
    return re.sub(r'\s+', ' ', text).strip()


def _trim(lines):
    """Without blank lines at both ends."""
    while lines and not lines[0].strip():
        lines = lines[1:]
    while lines and not lines[-1].strip():
        lines = lines[:-1]
    return lines


def _tail(found):
    return _lines(found['tail']) if found['tail'] else []


def _lines(text):
    """A comment's lines without its stars, and without the indentation that all but the first share."""
    lines = [re.sub(r'^\s*\*(?: |$)', '', l) if i else l.strip() for i, l in enumerate(text.split('\n'))]
    rest = [l for l in lines[1:] if l.strip()]
    if rest and not re.search(r'\n\s*\*', text):
        indent = min(len(l) - len(l.lstrip()) for l in rest)
        lines[1:] = [l[indent:] for l in lines[1:]]
    return _trim([l.rstrip() for l in lines])

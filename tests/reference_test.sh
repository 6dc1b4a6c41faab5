# scripts/reference makes a page that has everything the header declares and says, and whose links lead somewhere; and
# what looks for that sees a page that does not.
# SPDX-License-Identifier: Apache-2.0
set -eu
command -v python3 > /dev/null || exit 77
header=$BDPT_SOURCE_DIR/include/bdpt.h
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

cat > check.py << 'END'
"""check.py HEADER PAGE: knows the header by plain searches alone, not by the parser that the page was made with."""
import html.parser
import re
import sys

source = open(sys.argv[1], encoding='utf-8').read()


class Page(html.parser.HTMLParser):
    def __init__(self):
        super().__init__()
        self.ids, self.links, self.text, self.item, self.facts = [], [], [], '', {}
        self.inside = False

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.links += [attributes[a] for a in ('href', 'src') if a in attributes]
        if 'id' in attributes:
            self.ids.append(attributes['id'])
        if tag == 'h3':
            self.item = attributes['id']
        self.inside = self.inside or tag == 'th'

    def handle_endtag(self, tag):
        self.inside = self.inside and tag != 'th'

    def handle_data(self, data):
        self.text.append(data)
        if self.inside:
            self.facts.setdefault(self.item, []).append(data)


page = Page()
page.feed(open(sys.argv[2], encoding='utf-8').read())
lacks = []

code = re.sub(r'/\*.*?\*/', '', source, flags=re.S)
functions = re.findall(r'(\w+)\(', '\n'.join(re.findall(r'^BDPT_API .*', code, re.M)))
functions = [f for f in functions if f.startswith('bdpt_')]
declared = functions + re.findall(r'^#define (BDPT_(?!API|CHECK|H\b)\w+) ', code, re.M)
declared += re.findall(r'^typedef (?!struct).*?\b(bdpt_\w+)(?:;|\)\()', code, re.M)
structs = re.findall(r'^typedef struct (\w+) *(?:\{(.*?)\} \1)?;', code, re.M | re.S)
for name, fields in structs:
    declared.append(name)
    for field in fields.split(';'):
        pointer = re.search(r'\(\*(\w+)\)\s*\(', field)
        parts = [pointer[1]] if pointer else re.findall(r'(\w+)(?:\[\w+\])*\s*(?:,|$)', field.strip())
        declared += [f'{name}.{part}' for part in parts]
assert len(functions) > 80 and len(structs) > 70 and len(declared) > 900, (len(functions), len(structs), len(declared))
lacks += [f'{name} is not on the page' for name in declared if name not in page.ids]
lacks += [f'{name} is there twice' for name in set(page.ids) if page.ids.count(name) > 1]
lacks += [f'{link} leads nowhere' for link in page.links if link[:1] != '#' or link[1:] not in page.ids]
for name in functions:
    lacks += [f'{name} has no {label}' for label in ('Returns', 'Threads', 'Callbacks', 'Ownership')
              if label not in page.facts.get(name, [])]

# Every line of every comment, without blanks, in whatever it has become.
bare = lambda text: re.sub(r'[\s`·]', '', text)
text = bare(''.join(page.text))
for comment in re.findall(r'/\*(.*?)\*/', source.replace('/* BDPT_H */', ''), re.S):
    for line in comment.split('\n'):
        line = re.sub(r'^ *\* ?|^\s*-{3,}|-{3,} *$', '', line)
        for part in re.split(r'\b(?:Returns|Threads|Callbacks|Ownership|Source):|   +|\. ', line):
            if bare(part).rstrip('.') not in text:
                lacks.append(f'not on the page: {part.strip()}')

for lack in lacks:
    print(lack)
sys.exit(len(lacks) > 0)
END

"$BDPT_SOURCE_DIR/scripts/reference" "$folder" > /dev/null
python3 check.py "$header" index.html

# lacks LINE SED: the changed page is seen to lack that.
lacks() {
  sed -E "$2" index.html > planted.html
  ! cmp -s index.html planted.html || { echo "the page has no place for $2"; exit 1; }
  if python3 check.py "$header" planted.html > told.txt; then echo "not seen: $1"; exit 1; fi
  grep -qxF "$1" told.txt || { echo "not told: $1"; cat told.txt; exit 1; }
}
lacks 'bdpt_film_read is not on the page' 's/<h3 id="bdpt_film_read">/<h3 id="film_read">/'
lacks '#bdpt_film_read leads nowhere' 's/<h3 id="bdpt_film_read">/<h3 id="film_read">/'
lacks 'bdpt_read_desc.row_stride is not on the page' 's/ id="bdpt_read_desc\.row_stride"//'
lacks 'BDPT_LAYER_EYE is not on the page' 's/ id="BDPT_LAYER_EYE"//'
lacks 'bdpt_film is there twice' 's/<h3 id="bdpt_film">/&<i id="bdpt_film"><\/i>/'
lacks 'bdpt_version has no Threads' 's/<th>Threads/<th>Fibres/'
lacks 'style.css leads nowhere' 's/<style>/<link href="style.css">&/'
lacks 'not on the page: 3 channels: t <= 1' 's/3 channels: t &lt;= 1/3 channels/'
sed 's/Row 0 is the top row/Row 1 is the top row/' "$header" > planted.h
if python3 check.py planted.h index.html > told.txt; then exit 1; fi
grep -q 'not on the page: .*Row 1' told.txt

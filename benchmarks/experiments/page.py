#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes one page, index.html, and experiments.md of what bdpt_experiments wrote into a folder.

    page.py FOLDER [ID...]    the ids give the order; those without a file are told as not run

The page needs no network: pictures are inside it, plots are SVG. It is made of the standard library alone.
"""
import base64
import html
import json
import math
import pathlib
import sys

VERDICTS = {'agrees': 'agrees', 'partly': 'agrees in part', 'differs': 'does not agree', 'open': 'open', 'skipped': 'skipped',
            'none': 'not run', 'told': 'measured'}


def number(value):
    """Three digits, as short as they can be written."""
    if value is None:
        return '–'
    if value == int(value) and abs(value) < 1e6:
        return str(int(value))
    if 1e-3 <= abs(value) < 1e4:
        digits = max(0, 2 - math.floor(math.log10(abs(value))))
        return f'{value:.{digits}f}'
    return f'{value:.2e}'


def cell(value):
    if isinstance(value, dict):
        return value['text']
    return value if isinstance(value, str) else number(value)


# --- HTML ---

def picture(folder, file):
    data = base64.b64encode((folder / file).read_bytes()).decode()
    return f'data:image/png;base64,{data}'


def table_html(table):
    head = ''.join(f'<th>{html.escape(c)}</th>' for c in table['columns'])
    rows = ''.join('<tr>' + ''.join(f'<td>{html.escape(cell(v))}</td>' for v in row) + '</tr>'
                   for row in table['rows'])
    return (f'<div class="wide"><table><caption>{html.escape(table["title"])}</caption>'
            f'<thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table></div>')


def ticks(low, high):
    """1, 2 and 5 times powers of ten within [low, high]; the powers alone where there are many."""
    decades = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    steps = (1, 2, 5) if math.log10(high / low) < 2.5 else (1,)
    return [s * 10.0 ** d for d in decades for s in steps if low <= s * 10.0 ** d <= high]


def tick_text(value):
    return f'{value:g}' if 1e-3 <= value < 1e5 else f'{value:.0e}'


def bounds(values):
    low, high = min(values), max(values)
    room = (high / low) ** 0.06 if high > low else 2
    return low / room, high * room


def plot_html(plot):
    width, height, left, bottom, top, right = 560, 320, 64, 44, 10, 12
    points = [(s, [(x, y) for x, y in zip(s['x'], s['y']) if x and y['value'] and x > 0 and y['value'] > 0])
              for s in plot['series']]
    points = [(s, p) for s, p in points if p]
    if not points:
        return ''
    x0, x1 = bounds([x for _, p in points for x, _ in p])
    y0, y1 = bounds([y['value'] for _, p in points for _, y in p])
    px = lambda x: left + (width - left - right) * math.log(x / x0) / math.log(x1 / x0)
    py = lambda y: top + (height - top - bottom) * (1 - math.log(y / y0) / math.log(y1 / y0))
    out = [f'<svg viewBox="0 0 {width} {height}" role="img" aria-label="{html.escape(plot["title"])}">']
    for x in ticks(x0, x1):
        out.append(f'<path class="grid" d="M{px(x):.1f} {top}V{height - bottom}"/>'
                   f'<text x="{px(x):.1f}" y="{height - bottom + 16}" text-anchor="middle">{tick_text(x)}</text>')
    for y in ticks(y0, y1):
        out.append(f'<path class="grid" d="M{left} {py(y):.1f}H{width - right}"/>'
                   f'<text x="{left - 6}" y="{py(y) + 4:.1f}" text-anchor="end">{tick_text(y)}</text>')
    out.append(f'<text x="{(left + width) / 2}" y="{height - 8}" text-anchor="middle">{html.escape(plot["x"])}</text>')
    out.append(f'<text transform="translate(14 {(top + height - bottom) / 2}) rotate(-90)" text-anchor="middle">'
               f'{html.escape(plot["y"])}</text>')
    for i, (series, p) in enumerate(points):
        path = 'M' + 'L'.join(f'{px(x):.1f} {py(y["value"]):.1f}' for x, y in p)
        out.append(f'<g class="s{i % 8}"><path class="line" d="{path}"/>')
        for x, y in p:
            low, high = max(y['value'] - (y['error'] or 0), y0), min(y['value'] + (y['error'] or 0), y1)
            out.append(f'<path class="error" d="M{px(x):.1f} {py(low):.1f}V{py(high):.1f}"/>'
                       f'<circle cx="{px(x):.1f}" cy="{py(y["value"]):.1f}" r="3">'
                       f'<title>{html.escape(series["name"])}: {number(x)}, {html.escape(y["text"])}</title></circle>')
        out.append('</g>')
    out.append('</svg>')
    legend = ''.join(f'<span class="s{i % 8}"><i></i>{html.escape(s["name"])}</span>'
                     for i, (s, _) in enumerate(points))
    return (f'<figure class="plot"><figcaption>{html.escape(plot["title"])}</figcaption>{"".join(out)}'
            f'<div class="legend">{legend}</div></figure>')


def picture_html(folder, p):
    title = html.escape(p['title'])
    if p['kind'] == 'compare':
        left, right = html.escape(p['label']), html.escape(p['other_label'])
        return (f'<figure class="compare"><figcaption>{title}</figcaption><div class="pair">'
                f'<img src="{picture(folder, p["other_file"])}" alt="{right}">'
                f'<img class="over" src="{picture(folder, p["file"])}" alt="{left}">'
                f'<input type="range" min="0" max="100" value="50" aria-label="share of {left}"></div>'
                f'<div class="labels"><span>{left}</span><span>{right}</span></div></figure>')
    return (f'<figure class="{p["kind"]}"><figcaption>{title}</figcaption>'
            f'<img src="{picture(folder, p["file"])}" alt="{title}"></figure>')


def badge(verdict):
    return f'<span class="badge {verdict}">{VERDICTS[verdict]}</span>'


def section_html(folder, row):
    parts = [f'<section id="{row["id"]}"><h2>{html.escape(row["title"])} <code>{row["id"]}</code></h2>']
    claim = f'<b>{html.escape(row["paper"])}</b>' + (f': {html.escape(row["claim"])}' if row['claim'] else '')
    parts.append(f'<p class="claim">{claim}</p>')
    parts.append(f'<p class="verdict">{badge(row["verdict"])} {html.escape(row["verdict_text"])}</p>')
    if row['measured']:
        parts.append(f'<p>{html.escape(row["measured"])}</p>')
    parts += [f'<p class="note">{html.escape(n)}</p>' for n in row['notes']]
    parts += [table_html(t) for t in row['tables']]
    parts.append('<div class="plots">' + ''.join(plot_html(p) for p in row['plots']) + '</div>')
    parts.append('<div class="pictures">' + ''.join(picture_html(folder, p) for p in row['pictures']) + '</div>')
    parts.append(f'<p class="cost">{row["seconds"]:.0f} s, with {100 * row["processor_share"]:.0f} % of the cores.</p>')
    parts.append('</section>')
    return ''.join(parts)


STYLE = '''
:root{--text:#1d2125;--soft:#5c6670;--back:#fff;--card:#f5f6f7;--line:#d9dde1;--good:#1a7f37;--bad:#b42318;
--open:#7a6200;--s0:#1f6feb;--s1:#d1242f;--s2:#1a7f37;--s3:#9a6700;--s4:#8250df;--s5:#0a7d8c;--s6:#bf3989;--s7:#57606a}
@media(prefers-color-scheme:dark){:root{--text:#e4e7ea;--soft:#9aa4ae;--back:#14171a;--card:#1d2125;--line:#363c42;
--good:#4ac26b;--bad:#ff7b72;--open:#d4a72c;--s0:#58a6ff;--s1:#ff7b72;--s2:#4ac26b;--s3:#d4a72c;--s4:#bc8cff;
--s5:#39c5cf;--s6:#f778ba;--s7:#9aa4ae}}
*{box-sizing:border-box}
body{margin:0 auto;max-width:1100px;padding:1rem;background:var(--back);color:var(--text);
font:16px/1.5 system-ui,sans-serif}
h1{font-size:1.6rem;line-height:1.2}h2{font-size:1.25rem;margin:0 0 .5rem}h2 code{font-weight:400}
code{color:var(--soft);font-size:.85em}a{color:var(--s0)}
section{border-top:1px solid var(--line);padding:1.5rem 0}
.claim{border-left:3px solid var(--line);padding-left:.75rem;color:var(--soft);margin:.5rem 0}
.note,.cost{color:var(--soft);font-size:.9rem}.cost{margin-bottom:0}
.badge{display:inline-block;padding:0 .5em;border-radius:.3em;border:1px solid;font-size:.85rem;white-space:nowrap}
.agrees,.told{color:var(--good)}.differs{color:var(--bad)}.partly,.open,.skipped,.none{color:var(--open)}
.wide{overflow-x:auto;margin:1rem 0}table{border-collapse:collapse;font-variant-numeric:tabular-nums;font-size:.92rem}
caption{text-align:left;font-weight:600;padding-bottom:.3rem}
th,td{padding:.25rem .8rem .25rem 0;border-bottom:1px solid var(--line);text-align:right;vertical-align:top}
td:not(:first-child){white-space:nowrap}th:first-child,td:first-child{text-align:left}th{font-weight:600;color:var(--soft)}
.toc td:nth-child(2){white-space:normal}.toc td:nth-child(n+2),.toc th:nth-child(n+2){text-align:left}
.plots,.pictures{display:flex;flex-wrap:wrap;gap:1rem;align-items:flex-start}
figure{margin:0;background:var(--card);padding:.6rem;border-radius:.4rem;max-width:100%}
figcaption{font-size:.9rem;margin-bottom:.4rem}figure img{display:block;max-width:100%;height:auto}
.pyramid,.picture.big{width:100%}.pyramid img{margin:auto}
svg{width:100%;height:auto;display:block}svg text{fill:var(--soft);font:12px system-ui,sans-serif}
.grid{stroke:var(--line);fill:none}.line,.error{fill:none;stroke:var(--c);stroke-width:1.8}.error{stroke-width:1.2}
circle{fill:var(--c)}.legend span{font-size:.85rem;margin-right:1em;white-space:nowrap}
.legend i{display:inline-block;width:1em;height:.25em;margin-right:.4em;vertical-align:middle;background:var(--c)}
.s0{--c:var(--s0)}.s1{--c:var(--s1)}.s2{--c:var(--s2)}.s3{--c:var(--s3)}.s4{--c:var(--s4)}.s5{--c:var(--s5)}
.s6{--c:var(--s6)}.s7{--c:var(--s7)}
.compare,.plot{width:min(100%,526px)}.pair{position:relative;--at:50%}.pair img{width:100%}
.pair .over{position:absolute;inset:0;clip-path:inset(0 calc(100% - var(--at)) 0 0)}
.pair::after{content:"";position:absolute;top:0;bottom:0;left:var(--at);width:2px;margin-left:-1px;background:#fff;
box-shadow:0 0 3px #000}
.pair input{position:absolute;inset:0;width:100%;height:100%;margin:0;opacity:0;cursor:ew-resize}
.pair:focus-within{outline:2px solid var(--s0)}
.labels{display:flex;justify-content:space-between;gap:1rem;font-size:.85rem;color:var(--soft);margin-top:.3rem}
.labels span:last-child{text-align:right}
'''

SCRIPT = '''
for (const input of document.querySelectorAll('.pair input'))
  input.addEventListener('input', () => input.parentNode.style.setProperty('--at', input.value + '%'));
'''

INTRO = '''<p>Each row is one experiment of a paper, on its scene or the nearest there is. Variants take turns, A B A B, each
turn with a seed of its own. <b>Relative variance</b>: var / (mean² + 0.01 M²) of a pixel's grey, averaged over the pixels;
mean, and M, the mean of the whole picture, are those of a reference render. <b>Seconds</b>: processor time of all threads over their number. <b>Efficiency</b>: 1 / (relative
variance × seconds); what is told are ratios within one run, ± their standard errors over the turns.</p>'''


def page(folder, rows):
    sizes = sorted({r['size'] for r in rows if 'size' in r})
    lines = ''.join(f'<tr><td><a href="#{r["id"]}">{html.escape(r["title"])}</a></td><td>{html.escape(r["paper"])}</td>'
                    f'<td>{badge(r["verdict"])}</td></tr>' for r in rows)
    body = ''.join(section_html(folder, r) for r in rows if r['verdict'] != 'none')
    return (f'<!doctype html><html lang="en"><head><meta charset="utf-8"><meta name="viewport" '
            f'content="width=device-width,initial-scale=1"><meta name="color-scheme" content="light dark">'
            f'<title>bdpt: the papers\' experiments</title><style>{STYLE}</style></head><body>'
            f'<h1>bdpt: the papers\' experiments</h1>{INTRO}<p>This is a {" and ".join(sizes)} run.</p>'
            f'<div class="wide"><table class="toc"><thead><tr><th>experiment</th><th>paper</th><th>verdict</th></tr>'
            f'</thead><tbody>{lines}</tbody></table></div>{body}<script>{SCRIPT}</script></body></html>\n')


# --- Markdown ---

def bar(values):
    return '| ' + ' | '.join(str(v).replace('|', '\\|') for v in values) + ' |'


def markdown(rows):
    out = ['| id | paper | verdict | |', '|---|---|---|---|']
    out += [bar([f'`{r["id"]}`', r['paper'], VERDICTS[r['verdict']], r['verdict_text']]) for r in rows]
    for r in rows:
        if r['verdict'] == 'none':
            continue
        out += ['', f'## {r["id"]}: {r["title"]}', '', f'{r["paper"]}: {r["claim"]}', '', r['measured'],
                f'**{VERDICTS[r["verdict"]]}**: {r["verdict_text"]}', '']
        out += [n + '\n' for n in r['notes']]
        for t in r['tables']:
            out += [t['title'] + ':', '', bar(t['columns']), '|---' * len(t['columns']) + '|']
            out += [bar([cell(v) for v in row]) for row in t['rows']] + ['']
    return '\n'.join(out) + '\n'


def read(folder, experiment):
    path = folder / f'{experiment}.json'
    if path.exists():
        return json.loads(path.read_text())
    return {'id': experiment, 'title': experiment, 'paper': '', 'verdict': 'none', 'verdict_text': ''}


def main(arguments):
    if not arguments:
        sys.exit(__doc__)
    folder = pathlib.Path(arguments[0])
    ids = arguments[1:] or sorted(p.stem for p in folder.glob('*.json'))
    rows = [read(folder, i) for i in ids]
    if all(r['verdict'] == 'none' for r in rows):
        sys.exit(f'page.py: {folder}: no results; run bdpt_experiments -o {folder} first')
    (folder / 'index.html').write_text(page(folder, rows))
    (folder / 'experiments.md').write_text(markdown(rows))


if __name__ == '__main__':
    main(sys.argv[1:])

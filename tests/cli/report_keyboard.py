#!/usr/bin/env python3
"""Reads a report by keyboard alone, in a real browser:

    report_keyboard.py BROWSER PAGE.html

Tab reaches every folded part, link and scrolled table, each is seen to have the
focus, Enter opens what is folded, and Enter on a link shows what it names. Of
many components, which are made alike, three are read; of the others it is seen
that they open and close.
"""

import itertools
import json
import os
import pathlib
import subprocess
import sys
import tempfile

# Marks what the keyboard must reach, in the page as it is when opened.
MARK = """
(() => {
  const components = [...document.querySelectorAll('details.component')];
  const last = components.length - 1;
  components.forEach((c, i) => {
    const read = last < 6 || i === 0 || i === last >> 1 || i === last;
    if (!read) c.setAttribute('data-passed', '');
  });
  const all = [...document.querySelectorAll(
    'a[href], summary, [tabindex="0"], button, input, select, textarea')]
    .filter(e => e.matches('[data-passed] > summary') || !e.closest('[data-passed]'));
  all.forEach((e, i) => e.setAttribute('data-place', i));
  window.named = e => e.tagName + ' "' + e.textContent.trim().slice(0, 50) + '"';
  return all.length;
})()
"""

# What has the focus, and whether that is to be seen.
FOCUS = """
(() => {
  const e = document.activeElement;
  if (!e || e === document.body) return null;
  const style = getComputedStyle(e);
  const box = e.getBoundingClientRect();
  const details = e.tagName === 'SUMMARY' ? e.parentElement : null;
  return {
    place: Number(e.getAttribute('data-place')),
    name: named(e),
    seen: style.outlineStyle !== 'none' && parseFloat(style.outlineWidth) >= 2,
    inView: box.bottom > 0 && box.top < innerHeight && box.width > 0,
    folded: details !== null && !details.open,
    passed: details !== null && details.hasAttribute('data-passed'),
  };
})()
"""

# Of the elements by number: their names.
NAMES = """
(places => places.map(
  p => named(document.querySelector('[data-place="' + p + '"]'))))(%s)
"""

LINKS = """
[...document.querySelectorAll('a[href^="#"][data-place]')]
  .map(e => e.getAttribute('data-place'))
"""

# Folds everything but what lies around the link, which gets the focus.
FOCUS_LINK = """
(() => {
  const link = document.querySelector('[data-place="%s"]');
  document.querySelectorAll('details').forEach(d => { d.open = d.contains(link); });
  history.replaceState(null, '', location.pathname);
  link.focus();
})()
"""

# Where the link led.
LED = """
(() => {
  const link = document.querySelector('[data-place="%s"]');
  const name = link.getAttribute('href').slice(1);
  const target = document.getElementById(name);
  if (!target) return named(link) + ' names nothing';
  const box = target.getBoundingClientRect();
  const around = target.parentElement.closest('details');
  if (decodeURIComponent(location.hash.slice(1)) !== name) return named(link) + ' was not followed';
  if (around && !around.open) return named(link) + ' leads to what is folded';
  if (box.bottom <= 0 || box.top >= innerHeight) return named(link) + ' leads out of view';
  return '';
})()
"""


class Browser:
    """A page that is spoken to in the DevTools protocol, over pipes."""

    def __init__(self, program, url, profile):
        there, self._out = os.pipe()
        self._in, back = os.pipe()

        def take_ends():
            # The numbers that the browser expects; by way of others, since
            # the ends may have them already.
            for number, end in ((103, there), (104, back)):
                os.dup2(end, number)
            os.dup2(103, 3)
            os.dup2(104, 4)

        self._process = subprocess.Popen(
            [program, '--headless', '--no-sandbox', '--disable-gpu',
             '--disable-dev-shm-usage', '--no-first-run',
             '--disable-background-networking', '--disable-component-update',
             # Follows more than 200 links in 10 s, as no reader does.
             '--disable-ipc-flooding-protection',
             '--host-resolver-rules=MAP * ~NOTFOUND', '--remote-debugging-pipe',
             '--window-size=1280,900', '--user-data-dir=' + profile],
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL, close_fds=False, preexec_fn=take_ends)
        os.close(there)
        os.close(back)
        self._numbers = itertools.count(1)
        self._rest = b''
        self._session = None
        target = self.call('Target.createTarget', url='about:blank')['targetId']
        self._session = self.call('Target.attachToTarget', targetId=target,
                                  flatten=True)['sessionId']
        self.call('Page.enable')
        self.call('Page.navigate', url=url)
        while self._receive().get('method') != 'Page.loadEventFired':
            pass

    def close(self):
        self._process.kill()
        self._process.wait()

    def _receive(self):
        while b'\0' not in self._rest:
            more = os.read(self._in, 1 << 16)
            if not more:
                raise RuntimeError('the browser has gone')
            self._rest += more
        message, self._rest = self._rest.split(b'\0', 1)
        return json.loads(message)

    def call(self, method, **parameters):
        number = next(self._numbers)
        message = {'id': number, 'method': method, 'params': parameters}
        if self._session:
            message['sessionId'] = self._session
        os.write(self._out, json.dumps(message).encode() + b'\0')
        while True:
            answer = self._receive()
            if answer.get('id') == number:
                if 'error' in answer:
                    raise RuntimeError(f'{method}: {answer["error"]["message"]}')
                return answer['result']

    def ask(self, script):
        answer = self.call('Runtime.evaluate', expression=script,
                           returnByValue=True)
        if 'exceptionDetails' in answer:
            raise RuntimeError(str(answer['exceptionDetails']))
        return answer['result'].get('value')

    def press(self, key, code, text=None):
        event = {'key': key, 'code': key, 'windowsVirtualKeyCode': code}
        if text:
            event['text'] = text
        self.call('Input.dispatchKeyEvent', type='keyDown', **event)
        self.call('Input.dispatchKeyEvent', type='keyUp', key=key, code=key,
                  windowsVirtualKeyCode=code)


def tab_through(browser, number):
    """What is wrong on the way from the top to the end."""
    complaints = []
    reached = set()
    for _ in range(2 * number + 10):
        browser.press('Tab', 9)
        focus = browser.ask(FOCUS)
        if focus is None or focus['place'] in reached:
            break  # at the end
        reached.add(focus['place'])
        if not focus['seen']:
            complaints.append(f'{focus["name"]} does not show its focus')
        if not focus['inView']:
            complaints.append(f'{focus["name"]} has the focus out of view')
        if focus['folded']:
            browser.press('Enter', 13, '\r')
            if browser.ask(FOCUS)['folded']:
                complaints.append(f'Enter does not open {focus["name"]}')
            elif focus['passed']:
                browser.press('Enter', 13, '\r')
                if not browser.ask(FOCUS)['folded']:
                    complaints.append(f'Enter does not close {focus["name"]}')
    missed = sorted(set(range(number)) - reached)
    complaints += [f'Tab does not reach {name}'
                   for name in browser.ask(NAMES % json.dumps(missed))]
    return complaints


def follow_links(browser):
    complaints = []
    links = browser.ask(LINKS)
    for place in links:
        browser.ask(FOCUS_LINK % place)
        browser.press('Enter', 13, '\r')
        complaints.append(browser.ask(LED % place))
    return len(links), [c for c in complaints if c]


def main():
    program, page = sys.argv[1:]
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        browser = Browser(program, pathlib.Path(page).resolve().as_uri(), profile)
        try:
            number = browser.ask(MARK)
            complaints = tab_through(browser, number)
            links, of_links = follow_links(browser)
        finally:
            browser.close()
    complaints += of_links
    for complaint in complaints[:20]:
        print(f'report_keyboard: {page}: {complaint}', file=sys.stderr)
    print(f'report_keyboard: {number} places, {links} links by keyboard')
    return 1 if complaints or number < 1 else 0


if __name__ == '__main__':
    sys.exit(main())

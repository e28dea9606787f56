// Sections that have every word typed; those with one in their heading first.
(() => {
  const input = document.getElementById('find');
  const list = document.getElementById('found');
  const most = 12;
  input.addEventListener('input', () => {
    list.textContent = '';
    const words = input.value.toLowerCase().split(/\s+/).filter(Boolean);
    if (words.join('').length < 2) return;
    const hits = searchWords
      .map(([page, anchor, title, text]) => {
        const all = (title + ' ' + text).toLowerCase();
        if (!words.every(word => all.includes(word))) return null;
        const heading = title.toLowerCase();
        return { page, anchor, title, rank: words.filter(w => heading.includes(w)).length };
      })
      .filter(Boolean)
      .sort((a, b) => b.rank - a.rank)
      .slice(0, most);
    for (const hit of hits) {
      const link = document.createElement('a');
      link.href = input.dataset.up + 'cli/manual/' + hit.page + '.html#' + hit.anchor;
      link.textContent = hit.title;
      list.appendChild(document.createElement('li')).appendChild(link);
    }
    if (!hits.length) list.appendChild(document.createElement('li')).textContent = 'nothing found';
  });
})();

// main.js - puts the page together.

startLook();
document.getElementById('facts').append(...facts());
const sections = [sceneSection, decompositionSection, studySection, viewsSection, objectsSection, settingsSection]
  .map(make => make()).filter(Boolean);
document.getElementById('main').append(...sections);
document.getElementById('contents').append(...sections.map(one =>
  el('a', {href: `#${one.id}`}, one.querySelector('h2').textContent)));
document.documentElement.dataset.ready = 'yes';

// The designs of all projects. One element, as NiceGUI renders the whole page anew after each update: rows as elements of
// their own would make every update of the page slower.
export default {
  template: `
    <nav class="designs" aria-label="Designs">
      <q-input v-if="hasFilter" ref="filter" v-model="text" class="designs-filter" dense borderless clearable placeholder="Filter"
        aria-label="Filter designs" @keydown.enter="openFirst" />
      <template v-for="project in shownProjects" :key="project.key">
        <div class="project-head row">
          <div class="project-name">{{ project.name }}</div>
          <q-btn flat dense round size="sm" icon="add" class="icon-button" :aria-label="'New design in ' + project.name"
            @click="$emit('new-design', { key: project.key })">
            <q-tooltip>New design in {{ project.name }}</q-tooltip>
          </q-btn>
        </div>
        <component v-for="folder in project.folders" :key="folder.name" :is="folder.name ? 'details' : 'div'"
          :class="{ folder: folder.name }" :open="folder.name && isOpen(project, folder) ? '' : null">
          <summary v-if="folder.name" class="folder-head" @click.prevent="toggle(project, folder)">
            <div class="folder-name">{{ folder.name }}</div><div class="small">{{ folder.count }}</div>
          </summary>
          <div role="list" :aria-label="(project.name + ' ' + folder.name).trim()">
            <div v-for="row in folder.rows" :key="row.url" role="listitem" :class="{ 'design-row': row.component }"
              @contextmenu="row.component && openMenu($event, row)">
              <a v-if="row.component" class="design-link" :class="{ 'is-open': row.url === current }" :href="row.url" draggable="true"
                :aria-current="row.url === current ? 'page' : null" :aria-label="row.component + (isUnsaved(row) ? ', unsaved' : '')">
                <div class="design-name"><template v-for="(part, index) in partsOf(row.component)"><wbr v-if="index">{{ part }}</template></div>
                <div v-if="isUnsaved(row)" class="unsaved-mark" role="img" aria-label="unsaved">●</div>
              </a>
              <a v-else class="design-link is-broken" :href="row.url">
                <i class="q-icon material-icons" aria-hidden="true">error</i>
                <div class="design-name">{{ row.file }}</div>
                <q-tooltip>{{ row.hint }}</q-tooltip>
              </a>
              <button v-if="row.component" type="button" class="more-button" aria-haspopup="menu" :aria-label="'More for ' + row.component"
                :title="'More for ' + row.component" @click="openMenu($event, row)">
                <i class="q-icon material-icons" aria-hidden="true">more_vert</i>
                <q-menu v-if="menuUrl === row.url" :model-value="true" no-parent-event @hide="closeMenu(row)">
                  <q-list role="none">
                    <q-item v-for="entry in menu" :key="entry" v-close-popup clickable role="menuitem"
                      @click="$emit('menu', { entry, key: project.key, component: row.component })">
                      <q-item-section>{{ entry }}</q-item-section>
                    </q-item>
                  </q-list>
                </q-menu>
              </button>
            </div>
          </div>
        </component>
      </template>
      <div v-if="text && !shownProjects.some(hasRows)" class="empty">{{ noMatches }}</div>
    </nav>`,
  props: { projects: Array, current: String, unsaved: Array, menu: Array, hasFilter: Boolean, noMatches: String },
  data: () => ({ text: "", opened: {}, menuUrl: null }),
  computed: {
    words() {
      return (this.text ?? "").toLowerCase().split(/\s+/).filter(Boolean);
    },
    /** The projects with the rows that contain all words of the filter. */
    shownProjects() {
      if (!this.words.length) return this.projects;
      const matches = (row) => this.words.every((word) => (row.component || row.file).toLowerCase().includes(word));
      const shown = (folder) => ({ ...folder, rows: folder.rows.filter(matches) });
      return this.projects.map((project) => ({ ...project, folders: project.folders.map(shown).filter(({ rows }) => rows.length) }));
    },
    unsavedUrls() {
      return new Set(this.unsaved);
    },
  },
  watch: {
    current() {
      this.showCurrent();
    },
  },
  mounted() {
    this.showCurrent();
  },
  methods: {
    hasRows: ({ folders }) => folders.some(({ rows }) => rows.length),
    isUnsaved(row) {
      return this.unsavedUrls.has(row.url);
    },
    isOpen(project, folder) {
      return Boolean(this.words.length) || (this.opened[idOf(project, folder)] ?? project.isSmall);
    },
    toggle(project, folder) {
      this.opened[idOf(project, folder)] = !this.isOpen(project, folder);
    },
    /** Opens the folder of the current design, and scrolls to its row. */
    showCurrent() {
      for (const project of this.projects) {
        for (const folder of project.folders) {
          if (folder.rows.some(({ url }) => url === this.current)) this.opened[idOf(project, folder)] = true;
        }
      }
      this.$nextTick(() => this.$el.querySelector("[aria-current]")?.scrollIntoView({ block: "nearest" }));
    },
    openFirst() {
      const row = this.words.length && this.shownProjects.flatMap(({ folders }) => folders).flatMap(({ rows }) => rows)[0];
      if (!row) return;
      this.text = "";
      (window.openDesign ?? ((url) => location.assign(url)))(row.url);
    },
    openMenu(event, row) {
      event.preventDefault();
      this.menuUrl = row.url;
    },
    closeMenu(row) {
      if (this.menuUrl === row.url) this.menuUrl = null;
    },
    /** The words of a long name, between which it may break. */
    partsOf: (name) => (name.length > MAX_SOLID_NAME ? name.split(/(?<=_)(?=[^_])|(?<=[a-z0-9])(?=[A-Z])/) : [name]),
  },
};

const MAX_SOLID_NAME = 18;
const idOf = (project, folder) => `${project.key}\n${folder.name}`;
